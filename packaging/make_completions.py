#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""make_completions.py OUT PROGRAM...: shell completions from the programs' own --help.

Writes OUT/bash/NAME, OUT/zsh/_NAME and OUT/fish/NAME.fish for each program, so that they know what
the program knows: options, subcommands and the words an option takes; for --explain and --set the
keys of --print-schema. Everything else is a file."""
import json
import pathlib
import re
import subprocess
import sys

# "  -o,--output TEXT:{a,b} ...    words"; the words stand in a line of their own behind a long head
ITEM = re.compile(r"^  (?P<head>\S+(?: \S+)*)(?:\s{2,}(?P<words>.*))?$")
CHOICES = re.compile(r":\{([^}]*)\}")


class Option:
    """names: ["-o", "--output"]; takes: whether a value follows; choices: its words, if it has."""

    def __init__(self, head, text):
        names, _, rest = head.partition(" ")
        self.names = names.split(",")
        rest = re.sub(r"(REQUIRED|Excludes: .*)$", "", rest).strip()
        self.takes = bool(rest)
        listed = CHOICES.search(rest)
        self.choices = listed[1].split(",") if listed else []
        self.text = text


def read_help(program, *subcommand):
    """(options, subcommands as (name, text)) of a program or of one of its subcommands."""
    page = subprocess.run([program, *subcommand, "--help"], check=True, capture_output=True,
                          text=True).stdout
    section, options, subcommands = "", [], []
    lines = page.splitlines()
    for number, line in enumerate(lines):
        if re.match(r"^\w+:$", line):
            section = line[:-1]
            continue
        item = ITEM.match(line)
        if not item or section not in ("Options", "Subcommands"):
            continue
        words = item["words"] or lines[number + 1].strip()
        if section == "Options":
            options.append(Option(item["head"], words))
        else:
            subcommands.append((item["head"], words))
    if not options:
        raise SystemExit(f"make_completions.py: {program} --help lists no options")
    return options, subcommands


def read_keys(program):
    """Keys of the file that the program reads, with their tables: hull.speed, floes.gap."""
    def keys(schema, prefix):
        for name, sub in schema["properties"].items():
            table = sub if "properties" in sub else sub.get("items", {})
            if "properties" in table:
                yield from keys(table, f"{prefix}{name}.")
            else:
                yield prefix + name
    text = subprocess.run([program, "--print-schema"], check=True, capture_output=True,
                          text=True).stdout
    return list(keys(json.loads(text), ""))


def add_keys(options, program):
    """--explain takes a key or a table, --set a key and its value."""
    if any("--print-schema" in option.names for option in options):
        keys = read_keys(program)
        for option in options:
            if "--explain" in option.names:
                tables = dict.fromkeys(key.rpartition(".")[0] for key in keys if "." in key)
                option.choices = [*tables, *keys]
            elif "--set" in option.names:
                option.choices = [f"{key}=" for key in keys]


def bash_cases(options):
    """What follows an option that takes certain words."""
    return "".join(f"        {'|'.join(option.names)}) words='{' '.join(option.choices)}' ;;\n"
                   for option in options if option.choices)


def bash(name, options, subcommands):
    subs = " ".join(sub for sub, _, _ in subcommands)
    named = {sub: " ".join(n for option in own for n in option.names)
             for sub, _, own in subcommands}
    tables = "".join(f"        {sub}) options='{names}' ;;\n" for sub, names in named.items())
    own = " ".join(n for option in options for n in option.names)
    every = options + [option for _, _, found in subcommands for option in found]
    return f"""# bash completion of {name}, made from its --help
_{name}() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD - 1]}}
    local command='' words='' part
    local options='{own}' subcommands='{subs}'
    for part in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        [[ -z $command && " $subcommands " == *" $part "* ]] && command=$part
    done
    case $command in
{tables}        *) ;;
    esac
    case $last in
{bash_cases(every)}        *)
            if [[ $word == -* ]]; then
                words=$options
            elif [[ -z $command ]]; then
                words=$subcommands
            fi
            ;;
    esac
    if [[ -n $words ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
        [[ ${{COMPREPLY[0]-}} == *= ]] && compopt -o nospace 2>/dev/null
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}}
complete -o filenames -F _{name} {name}
"""


def zsh_quoted(text):
    return re.sub(r"([\[\]:\\])", r"\\\1", text).replace("'", "'\\''")


def zsh_arguments(options):
    specs = []
    for option in options:
        follows = ""
        if option.takes:
            words = " ".join(option.choices)
            follows = f":value:({words})" if words else ":value:_files"
            if "--set" in option.names and words:  # the value follows without a space
                follows = f':value:{{compadd -S "" -- {words}}}'
        specs += [f"'*{n}[{zsh_quoted(option.text)}]{follows}'" for n in option.names]
    return " \\\n        ".join(specs + ["'*:file:_files'"])


def zsh(name, options, subcommands):
    if not subcommands:
        return f"#compdef {name}\n_arguments \\\n        {zsh_arguments(options)}\n"
    listed = " ".join(f"'{sub}:{zsh_quoted(text)}'" for sub, text, _ in subcommands)
    cases = "".join(f"    {sub})\n        _arguments \\\n        {zsh_arguments(own)}\n        ;;\n"
                    for sub, _, own in subcommands)
    return f"""#compdef {name}
local command=${{words[(r)({'|'.join(sub for sub, _, _ in subcommands)})]}}
case $command in
{cases}    *)
        local -a commands=({listed})
        _describe command commands
        _arguments {zsh_arguments(options)}
        ;;
esac
"""


def fish(name, options, subcommands):
    def quoted(text):
        return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"

    def line(option, condition):
        out = f"complete -c {name}" + (f" -n {quoted(condition)}" if condition else "")
        for n in option.names:
            out += f" -l {n[2:]}" if n.startswith("--") else f" -s {n[1:]}"
        if option.choices:
            out += f" -x -a {quoted(' '.join(option.choices))}"
        elif option.takes:
            out += " -r"
        return out + f" -d {quoted(option.text)}\n"

    text = f"# fish completion of {name}, made from its --help\n"
    text += "".join(line(option, "") for option in options)
    for sub, words, own in subcommands:
        text += f"complete -c {name} -n __fish_use_subcommand -a {sub} -d {quoted(words)}\n"
        text += "".join(line(option, f"__fish_seen_subcommand_from {sub}") for option in own)
    return text


def main():
    out = pathlib.Path(sys.argv[1])
    for program in sys.argv[2:]:
        name = pathlib.Path(program).name
        options, subcommands = read_help(program)
        add_keys(options, program)
        subcommands = [(sub, words, read_help(program, sub)[0]) for sub, words in subcommands]
        for path, text in ((f"bash/{name}", bash(name, options, subcommands)),
                           (f"zsh/_{name}", zsh(name, options, subcommands)),
                           (f"fish/{name}.fish", fish(name, options, subcommands))):
            (out / path).parent.mkdir(parents=True, exist_ok=True)
            (out / path).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

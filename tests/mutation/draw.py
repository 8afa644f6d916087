# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws faults from the sources by operators: a sign, a comparison, a constant, min for max, a term
or a statement left out, another index, `and` for `or`, a condition that never holds.

Works on the text of functions' statements, conditions and returned values. Kernels with a twin are
left out, since a fault in one of two is noticed by their comparison: mutants.toml has faults that
both twins get. Headers are left out, too: nearly all of them are compiled into everything.
"""
import collections
import dataclasses
import pathlib
import random
import re

FOLDERS = ("solver", "common", "postprocess", "preprocess/fill")
TWINS = ("_reference.cpp", "_simd.cpp")
TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|[A-Za-z_]\w*|'
                   r"(?:0[xX][0-9a-fA-F']+|\d[\d']*\.?\d*(?:[eE][-+]?\d+)?|\.\d+)\w*|"
                   r"<=>|<<=|>>=|->\*|\.\.\.|::|->|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.",
                   re.S)
KINDS = ("sign", "comparison", "constant", "min/max", "dropped term", "index", "and/or",
         "product", "dropped statement", "never")
OPPOSITE = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
COMPARE = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
PRODUCT = {"*": "/", "/": "*", "*=": "/=", "/=": "*="}
EXTREME = {"min": "max", "max": "min", "minCoeff": "maxCoeff", "maxCoeff": "minCoeff",
           "Min": "Max", "Max": "Min", "min_element": "max_element", "max_element": "min_element",
           "fmin": "fmax", "fmax": "fmin", "lower_bound": "upper_bound", "floor": "ceil",
           "ceil": "floor", "cos": "sin", "sin": "cos", "front": "back", "back": "front"}
AXIS = {"x": "y", "y": "z", "z": "x"}
LOGIC = {"&&": "||", "||": "&&", "true": "false", "false": "true"}
NO_VALUE = {"throw", "break", "continue", "goto", "case", "default", "using", "static_assert",
            "namespace", "typedef", "static", "constexpr", "template", "struct", "class", "enum",
            "extern", "friend", "delete", "co_return"}


@dataclasses.dataclass(frozen=True)
class Fault:
    """`begin` to `end` of a file's text, a statement or a condition, becomes `new`."""
    file: str
    begin: int
    end: int
    kind: str
    old: str
    new: str
    form: str  # "statement", "condition" or the type of a declared value

    def planted(self, number):
        """The text with both, of which ICE_MUTANT chooses; as many lines as before."""
        asked = f"ice::kMutant == {number}"
        new = " ".join(self.new.split())
        if self.form == "condition":
            return f"({asked} ? bool({new}) : bool({self.old}))"
        if self.form == "statement":
            return f"{{ if ({asked}) {{ {new} }} else {{ {self.old} }} }}"
        if self.form == "auto":
            return f"({asked} ? ({new}) : ({self.old}))"
        return f"({asked} ? {self.form}({new}) : {self.form}({self.old}))"


def blank_comments(text):
    """Comments and preprocessor lines become blanks, so that places stay."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'',
                  lambda m: m.group() if m.group()[0] in "\"'" else blank(m), text, flags=re.S)
    text = re.sub(r'R"(\w*)\(.*?\)\1"', blank, text, flags=re.S)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def tokens_of(text):
    """Pairs of place and token, without blanks."""
    return [(m.start(), m.group()) for m in TOKEN.finditer(text) if not m.group().isspace()]


def closing(tokens, at):
    """Index of the bracket that closes the one at `at`."""
    depth = 0
    for k in range(at, len(tokens)):
        depth += (tokens[k][1] in "([{") - (tokens[k][1] in ")]}")
        if depth == 0:
            return k
    return len(tokens) - 1


def is_block(tokens, at):
    """Does the brace at `at` open statements, not a list, a type or a namespace?"""
    before = tokens[at - 1][1] if at else ""
    if before in (")", "else", "do", "try", "const", "noexcept", "override", ";", "{", "}",
                  "mutable"):
        return True
    # a trailing return type
    back = [t for _, t in tokens[max(0, at - 8):at]]
    return "->" in back and ")" in back


def statements(tokens):
    """Ranges [first, last] of tokens of statements in blocks; the last is the semicolon."""
    blocks, first = [], 0
    for k, (_, token) in enumerate(tokens):
        if token == "{":
            blocks.append(is_block(tokens, k) and head_is_code(tokens, first, k))
            first = k + 1 if blocks[-1] or not any(blocks) else first
        elif token == "}":
            plain = blocks.pop() if blocks else False
            first = k + 1 if plain or not any(blocks) else first
        elif token == ";" and balance(tokens, first, k) == 0:
            if any(blocks):
                yield first, k
            first = k + 1


def head_is_code(tokens, first, k):
    return not {"namespace", "struct", "class", "enum", "union"} & {t for _, t in tokens[first:k]}


def balance(tokens, first, last):
    return sum((t in "([{") - (t in ")]}") for _, t in tokens[first:last])


def changes(text, tokens):
    """Pairs of kind and changed text for every operator that an expression has."""
    begin, end = tokens[0][0], tokens[-1][0] + len(tokens[-1][1])

    def put(at, token, new):
        return text[begin:at] + new + text[at + len(token):end]

    for k, (at, token) in enumerate(tokens):
        spaced = text[at - 1:at] in " \n" and text[at + len(token):at + len(token) + 1] in " \n"
        before = tokens[k - 1][1] if k else ""
        after = tokens[k + 1][1] if k + 1 < len(tokens) else ""
        if token in OPPOSITE and spaced and k:
            yield "sign", put(at, token, OPPOSITE[token])
            if token in "+-":
                stop = term_end(tokens, k + 1)
                yield "dropped term", text[begin:at] + text[stop:end]
        elif token == "-" and not spaced and before in ("(", ",", "=", "return", "?", ":", "*"):
            yield "sign", put(at, token, "")
        elif token in COMPARE and spaced:
            yield "comparison", put(at, token, COMPARE[token])
        elif token in PRODUCT and spaced:
            yield "product", put(at, token, PRODUCT[token])
        elif token in EXTREME and after in ("(", "<"):
            yield "min/max", put(at, token, EXTREME[token])
        elif token in AXIS and before == "." and after == "(":
            yield "index", put(at, token, AXIS[token])
        elif token in LOGIC:
            yield "and/or", put(at, token, LOGIC[token])
        elif token == "!" and re.match(r"\w|\(", after):
            yield "and/or", put(at, token, "")
        elif token[0].isdigit() and not token.startswith("0x"):
            yield ("index" if before == "[" and after == "]" else "constant"), put(
                at, token, other_number(token))
        elif token == "[" and before.isidentifier() and re.fullmatch(r"[a-z]\w*", after) and \
                tokens[min(k + 2, len(tokens) - 1)][1] == "]":
            yield "index", put(tokens[k + 1][0], after, f"{after} ^ 1")


def other_number(token):
    digits = re.match(r"[\d'.]+(?:[eE][-+]?\d+)?", token).group()
    value = float(digits.replace("'", ""))
    if re.fullmatch(r"[\d']+", digits):
        return f"{int(value) + 1}" + token[len(digits):]
    return f"{2 * value if value else 1.0!r}" + token[len(digits):]


def term_end(tokens, k):
    """Place behind the term that begins with token k: the next sum or the brackets' end."""
    depth = 0
    while k < len(tokens):
        token = tokens[k][1]
        if depth == 0 and token in (",", ")", "]", ";", "+", "-", "<", ">", "<=", ">=", "==", "!=",
                                    "&&", "||", "?", ":", "}"):
            return tokens[k][0]
        depth += (token in "([{") - (token in ")]}")
        k += 1
    return tokens[-1][0] + len(tokens[-1][1])


def faults_of_statement(name, text, tokens, first, last):
    head = tokens[first][1]
    inner = tokens[first:last + 1]
    # conditions before a statement, or in a loop's head
    while head in ("if", "while", "for", "else"):
        if head == "else":
            first += 1
        else:
            k = first + 1
            if tokens[k][1] == "constexpr" or tokens[k][1] != "(":
                return
            end = closing(tokens, k)
            yield from faults_of_condition(name, text, tokens, k, end, head)
            first = end + 1
        if first >= last:
            return
        head, inner = tokens[first][1], tokens[first:last + 1]
    if head in NO_VALUE or "{" in [t for _, t in inner] or "[" == head:
        return
    begin, end = inner[0][0], inner[-1][0] + 1
    old = text[begin:end]
    words = [t for _, t in inner]
    declared = re.match(
        r"(?:const\s+)?([A-Za-z_][\w:]*(?:<[^=;()]*>)?)(?:\s+|\s*&\s*)(\w+)\s*=[^=]", old)
    if head == "return":
        if len(inner) > 2:
            for kind, new in changes(text, inner):
                yield Fault(name, begin, end, kind, old, new, "statement")
    elif declared and declared.group(1) not in ("return", "else", "delete"):
        if "&" in old.split("=", 1)[0]:
            return
        value = inner[words.index("=") + 1:-1]
        if any(t == "," and balance(value, 0, k) == 0 for k, (_, t) in enumerate(value)):
            return  # several names
        at, stop = value[0][0], value[-1][0] + len(value[-1][1])
        for kind, new in changes(text, value):
            yield Fault(name, at, stop, kind, text[at:stop], new, declared.group(1))
    elif is_expression(old):
        for kind, new in changes(text, inner):
            yield Fault(name, begin, end, kind, old, new, "statement")
        yield Fault(name, begin, end, "dropped statement", old, ";", "statement")


def is_expression(old):
    return old[:2] in ("++", "--") or re.match(
        r"[\w.:>()\[\]*+-]+(?:\s*(?:[-+*/|&]?=[^=]|\()|\+\+;|--;)", old)


def faults_of_condition(name, text, tokens, k, end, head):
    parts = [k]
    depth = 0
    for m in range(k, end + 1):
        depth += (tokens[m][1] in "([{") - (tokens[m][1] in ")]}")
        if tokens[m][1] == ";" and depth == 1:
            parts.append(m)
    if head == "for" and len(parts) != 3:
        return
    first, last = (parts[1], parts[2]) if head == "for" else (parts[-1], end)
    inner = tokens[first + 1:last]
    old = text[tokens[first][0] + 1:tokens[last][0]].strip()
    if not inner or "{" in old or re.match(r"const |auto |[\w:<>]+[*&]* \w+ =[^=]", old):
        return
    begin, stop = inner[0][0], inner[-1][0] + len(inner[-1][1])
    for kind, new in changes(text, inner):
        yield Fault(name, begin, stop, kind, text[begin:stop], new, "condition")
    if head == "if":
        yield Fault(name, begin, stop, "never", text[begin:stop], "false", "condition")


def faults_of_file(root, path):
    name = str(path.relative_to(root))
    text = path.read_text(encoding="utf-8")
    clean = blank_comments(text)
    tokens = tokens_of(clean)
    for first, last in statements(tokens):
        for fault in faults_of_statement(name, clean, tokens, first, last):
            old = text[fault.begin:fault.end]
            if " ".join(fault.new.split()) != " ".join(old.split()) and "//" not in old:
                yield dataclasses.replace(fault, old=old)


def every_fault(root):
    root = pathlib.Path(root)
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.cpp")):
            if not path.name.endswith(TWINS):
                yield from faults_of_file(root, path)


def draw(root, seed, files=None, most_per_file=4):
    """All faults in an order that only the seed decides: kinds take turns, no two faults share a
    statement, and no file has more than `most_per_file`.

    @param files  how many files to draw from, likelier the more faults they can have; default all
    """
    dice = random.Random(seed)
    every = list(every_fault(root))
    if files:
        kept = set()
        for fault in dice.sample(every, len(every)):
            if len(kept) < files:
                kept.add(fault.file)
        every = [fault for fault in every if fault.file in kept]
    by_kind = collections.defaultdict(list)
    for fault in every:
        by_kind[fault.kind].append(fault)
    for kind in KINDS:
        dice.shuffle(by_kind[kind])
    taken = collections.defaultdict(list)
    while any(by_kind.values()):
        for kind in KINDS:
            while by_kind[kind]:
                fault = by_kind[kind].pop()
                others = taken[fault.file]
                if len(others) < most_per_file and all(
                        fault.end <= o.begin or o.end <= fault.begin for o in others):
                    others.append(fault)
                    yield fault
                    break

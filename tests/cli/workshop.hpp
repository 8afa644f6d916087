// SPDX-License-Identifier: GPL-3.0-or-later
// The programs run from outside, in a folder of their own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace ice::test {

namespace fs = std::filesystem;

struct Result {
    int code;
    std::string out, err;
};

inline std::string slurp(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

// A folder of its own for every test, removed at the end.
class Workshop {
public:
    Workshop() {
        static int number = 0;
        folder_ = fs::temp_directory_path() /
                  ("ice-cli-" + std::to_string(::getpid()) + "-" + std::to_string(++number));
        fs::create_directories(folder_);
    }
    ~Workshop() { fs::remove_all(folder_); }

    fs::path operator/(const std::string& name) const { return folder_ / name; }

    Result run(const std::string& command) const {
        const fs::path out = folder_ / "out.txt", err = folder_ / "err.txt";
        const std::string line = "cd '" + folder_.string() + "' && " ICE_BIN "/" + command + " >'" +
                                 out.string() + "' 2>'" + err.string() + "'";
        const int status = std::system(line.c_str());
        Result r{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
        fs::remove(out);
        fs::remove(err);
        return r;
    }

    // Calls like refuses("--option x", "words"): the command with these arguments ends with exit
    // code 2 and a message that contains the words.
    auto refusing(const std::string& command) const {
        return [this, command](const std::string& arguments, const std::string& words) {
            const Result r = run(command + arguments);
            CAPTURE(arguments, r.err);
            CHECK(r.code == 2);
            CHECK_THAT(r.err, Catch::Contains(words));
        };
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    // hull and floe sets of the paper's 2D case and a short case; `extra` goes on in [output]
    void make_case(const std::string& extra = "") const {
        REQUIRE(run("spherize " ICE_MESHES "/paper-hull-2d.obj --slice y=0 -o hull.h5 -q").code ==
                0);
        REQUIRE(run("spherize " ICE_MESHES "/paper-floe-2d.obj --slice y=0 -o floe.h5 -q").code ==
                0);
        write("case.cfg", slurp(ICE_SHORT_CASE) + R"([output]
track = [1]
average_from = 1.0
)" + extra);
    }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_))
            if (entry.is_regular_file())
                names.push_back(fs::relative(entry.path(), folder_).string());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    fs::path folder_;
};

}  // namespace ice::test

// SPDX-License-Identifier: Apache-2.0
/// A program named ffmpeg, first in PATH, that a test writes as a shell script; and PATH as it was, afterwards.
#pragma once

#include "tests/base/ScopedVariable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace filament_core::view {

class FakeFfmpeg {
public:
    /// Without a script there is none: PATH is the empty folder alone.
    FakeFfmpeg(std::filesystem::path folder, std::string const& script) : mFolder(std::move(folder)) {
        std::filesystem::create_directories(mFolder);
        const std::filesystem::path program = mFolder / "ffmpeg";
        std::filesystem::remove(program);
        if (!script.empty()) {
            std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
            std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        }
        mPath.set(script.empty() ? mFolder.string() : mFolder.string() + ":" + mPath.before().value_or(""));
    }

private:
    std::filesystem::path mFolder;
    test::ScopedVariable mPath{ "PATH", "" };
};

/// Keeps its words, one a line, in `words`, and writes its last word, the output.
inline std::string scriptThatKeepsWords(std::filesystem::path const& words) {
    return "printf '%s\\n' \"$@\" > '" + words.string() + "'\nfor last; do :; done\necho video > \"$last\"";
}

inline std::string textOfFile(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), {} };
}

} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
/// FakeRoot: a temporary directory that tests fill with files and use as "/".
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace filament_core::jobs {

class FakeRoot {
public:
    FakeRoot() {
        static std::atomic<int> number = 0;
        mPath = std::filesystem::temp_directory_path() /
                ("filament_root_" + std::to_string(getpid()) + '_' + std::to_string(number++));
        std::filesystem::create_directories(mPath);
    }
    ~FakeRoot() { std::filesystem::remove_all(mPath); }
    FakeRoot(FakeRoot const&) = delete;
    FakeRoot& operator=(FakeRoot const&) = delete;

    std::filesystem::path const& path() const { return mPath; }

    void write(std::string_view file, std::string_view text) const {
        std::filesystem::create_directories((mPath / file).parent_path());
        std::ofstream(mPath / file, std::ios::binary) << text;
    }

private:
    std::filesystem::path mPath;
};

} // namespace filament_core::jobs

// SPDX-License-Identifier: Apache-2.0
/// BakeRun: a folder of its own for a test, in which programs run.
#pragma once

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::bake::test {

class BakeRun : public ::testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(mFolder); }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    void write(char const* name, assets::GlbScene const& scene) const {
        const auto bytes = assets::writeGlb(scene);
        ASSERT_TRUE(bytes) << bytes.error().message;
        ASSERT_TRUE(assets::replaceFile(mFolder / name, *bytes));
    }

    struct Outcome {
        int status = -1;
        std::string text; ///< of both outputs
    };
    /// filament-bake with these arguments.
    Outcome run(std::string const& arguments) const { return shell("'" + program() + "' " + arguments); }
    Outcome shell(std::string const& line) const {
        const std::string command = "cd '" + mFolder.string() + "' && { " + line + "; } 2>&1";
        std::FILE* const pipe = ::popen(command.c_str(), "r");
        Outcome outcome;
        std::array<char, 512> buffer{};
        while (std::fgets(buffer.data(), buffer.size(), pipe)) outcome.text += buffer.data();
        outcome.status = WEXITSTATUS(::pclose(pipe));
        return outcome;
    }
    static std::string program() { return (tools::buildDir() / "bin/filament-bake").string(); }

    std::string read(std::filesystem::path const& name) const {
        std::ifstream file(mFolder / name, std::ios::binary);
        return { std::istreambuf_iterator<char>(file), {} };
    }

    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("filament-bake-" + std::to_string(::getpid()));
};

} // namespace filament_core::bake::test

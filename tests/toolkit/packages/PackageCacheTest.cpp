// SPDX-License-Identifier: Apache-2.0
// A package comes from the cache only if nothing changed on which it depends.
#include "toolkit/packages/PackageCache.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <thread>

namespace filament_core::tools {
namespace {

namespace fs = std::filesystem;
using shader::CompileOptions;

std::string paint(int shade) {
    return fmt::format("material {{ shadingModel : unlit, variantFilter : [ skinning, fog, ssr, vsm ] }}\nfragment "
                       "{{\n#include \"paint.inc\"\n"
                       "void material(inout MaterialInputs material) {{ prepareMaterial(material);\n"
                       "material.baseColor.r = kGrey + {}.0; }} }}\n",
                       shade);
}

class PackageCacheTest : public testing::Test {
protected:
    PackageCacheTest() { fs::remove_all(mCache.folder); }
    ~PackageCacheTest() override { fs::remove_all(mCache.folder); }

    shader::IncludeResolver included() const {
        return [this](std::string_view include) -> std::optional<std::string> {
            return include == "paint.inc" ? std::optional(mInclude) : std::nullopt;
        };
    }
    CompiledPackage compiled(CompileOptions options = {}, std::string const& text = paint(0),
                             std::string_view name = "paint.mat") {
        options.includes = included();
        auto found = compilePackage(text, name, options, mCache);
        EXPECT_TRUE(found) << (found ? "" : found.error().message);
        return found ? std::move(*found) : CompiledPackage{};
    }
    std::vector<std::byte> ofCompiler(CompileOptions options = {}, std::string const& text = paint(0)) const {
        options.includes = included();
        const auto package = shader::compileMaterial(text, "paint.mat", options);
        EXPECT_TRUE(package) << (package ? "" : package.error().message);
        return package ? shader::writePackage(*package) : std::vector<std::byte>{};
    }
    bool isKept(CompileOptions const& options = {}) { return compiled(options).isKept; }

    std::vector<fs::path> entries() const {
        std::vector<fs::path> found;
        for (fs::directory_entry const& entry : fs::directory_iterator(mCache.folder)) found.push_back(entry.path());
        return found;
    }

    PackageCache mCache{ .folder = fs::path(testing::TempDir()) / "package-cache-test", .compiler = "this one" };
    std::string mInclude = "const float kGrey = 0.5;";
};

TEST_F(PackageCacheTest, CompilesOnceForTwoPrograms) {
    const std::vector<std::byte> expected = ofCompiler();
    const CompiledPackage first = compiled(), second = compiled();
    EXPECT_FALSE(first.isKept);
    EXPECT_EQ(first.bytes, expected);
    EXPECT_TRUE(second.isKept);
    EXPECT_EQ(second.bytes, expected);
    EXPECT_EQ(entries().size(), 1u);
}

TEST_F(PackageCacheTest, CompilesAgainForAnotherCompilerTextOrName) {
    compiled();
    EXPECT_FALSE(compiled({}, paint(1)).isKept);
    EXPECT_FALSE(compiled({}, paint(0), "other.mat").isKept) << "errors and the package name the file";
    mCache.compiler = "another one";
    EXPECT_FALSE(isKept());
    mCache.compiler = "this one";
    EXPECT_TRUE(isKept());
}

TEST_F(PackageCacheTest, CompilesAgainForEveryOption) {
    const std::pair<const char*, std::function<void(CompileOptions&)>> changes[] = {
        { "exact", [](CompileOptions& options) { options.exact = false; } },
        { "optimization", [](CompileOptions& options) { options.optimization = shader::Optimization::Size; } },
        { "spirv", [](CompileOptions& options) { options.spirv = false; } },
        { "essl", [](CompileOptions& options) { options.essl = false; } },
        { "platform", [](CompileOptions& options) { options.platform = shader::Platform::Mobile; } },
        { "filteredVariants", [](CompileOptions& options) { options.filteredVariants = shader::kVariantDebug; } },
        { "onlyVariant", [](CompileOptions& options) { options.onlyVariant = shader::kVariantDebug; } },
        { "defines",
          [](CompileOptions& options) {
              options.defines = { { "SHADE", "1" } };
          } },
    };
    compiled();
    for (auto const& [name, change] : changes) {
        CompileOptions options;
        change(options);
        EXPECT_FALSE(isKept(options)) << name;
        const CompiledPackage again = compiled(options);
        EXPECT_TRUE(again.isKept) << name;
        EXPECT_EQ(again.bytes, ofCompiler(options)) << name;
    }
    EXPECT_TRUE(isKept());
    std::vector<std::string> warnings;
    EXPECT_FALSE(isKept({ .warnings = &warnings })) << "warnings are made by compiling";
}

TEST_F(PackageCacheTest, CompilesAgainIfAnIncludedFileChangedOrWentAway) {
    compiled();
    mInclude = "const float kGrey = 0.75;";
    const CompiledPackage changed = compiled();
    EXPECT_FALSE(changed.isKept);
    EXPECT_EQ(changed.bytes, ofCompiler());
    EXPECT_TRUE(isKept());
    const auto gone = compilePackage(paint(0), "paint.mat", {}, mCache);
    EXPECT_FALSE(gone) << "there is no paint.inc any more";
}

TEST_F(PackageCacheTest, KeepsNoErrors) {
    for (int i = 0; i < 2; ++i) {
        const auto wrong = compilePackage("material { name : 1 : 2 }", "wrong.mat", {}, mCache);
        ASSERT_FALSE(wrong);
        EXPECT_NE(wrong.error().message.find("wrong.mat"), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(mCache.folder));
}

TEST_F(PackageCacheTest, CompilesAgainIfAnEntryIsDamaged) {
    compiled();
    ASSERT_EQ(entries().size(), 1u);
    const fs::path entry = entries()[0];
    const std::vector<std::byte> whole = *assets::readFileBytes(entry);
    for (size_t at = 0; at < whole.size(); at += 1 + whole.size() / 8) {
        std::vector<std::byte> damaged = whole;
        damaged[at] ^= std::byte{ 4 };
        ASSERT_TRUE(assets::replaceFile(entry, damaged));
        EXPECT_FALSE(isKept()) << "byte " << at;
        ASSERT_TRUE(assets::replaceFile(entry, std::span(whole).first(at)));
        EXPECT_FALSE(isKept()) << "cut at " << at;
    }
    EXPECT_TRUE(isKept());
}

TEST_F(PackageCacheTest, DropsWhatWasUsedLongestAgo) {
    compiled();
    mCache.maxBytes = 4 * fs::file_size(entries()[0]) + 1000;
    const auto age = [this](fs::path const& entry) {
        fs::last_write_time(entry, fs::last_write_time(entry) - std::chrono::hours(1));
    };
    for (int shade = 1; shade < 4; ++shade) {
        for (fs::path const& entry : entries()) age(entry);
        compiled({}, paint(shade));
    }
    EXPECT_EQ(entries().size(), 4u);
    EXPECT_TRUE(isKept()) << "the oldest, and now the one that was used last";
    compiled({}, paint(4));
    EXPECT_LT(entries().size(), 4u);
    EXPECT_TRUE(isKept());
    EXPECT_TRUE(compiled({}, paint(4)).isKept);
    EXPECT_FALSE(compiled({}, paint(1)).isKept);
}

TEST_F(PackageCacheTest, ServesSeveralAtOnce) {
    mCache.maxBytes = 20'000; // entries come and go meanwhile
    std::array<std::vector<std::byte>, 3> expected;
    for (int shade = 0; shade < 3; ++shade) expected[shade] = ofCompiler({}, paint(shade));
    std::vector<std::thread> threads;
    std::atomic<int> wrong{ 0 };
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&, thread] {
            for (int round = 0; round < 6; ++round) {
                const int shade = (thread + round) % 3;
                const auto found = compilePackage(paint(shade), "paint.mat", { .includes = included() }, mCache);
                wrong += !found || found->bytes != expected[shade];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
}

TEST(CompilerIdentity, IsThatOfTheMatcOfThisBuild) {
    const std::string command = fmt::format("sha256sum '{}'", (buildDir() / "bin/matc").string());
    FILE* const pipe = ::popen(command.c_str(), "r");
    ASSERT_TRUE(pipe);
    std::array<char, 65> hash{};
    const size_t read = std::fread(hash.data(), 1, 64, pipe);
    ::pclose(pipe);
    ASSERT_EQ(read, 64u);
    EXPECT_EQ(compilerIdentity(), hash.data());
}

} // namespace
} // namespace filament_core::tools

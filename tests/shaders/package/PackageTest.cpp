// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Package.h"

#include "base/Hash.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/ByteReader.h"
#include "shaders/package/PackageFormat.h"
#include "shaders/package/ParameterLayout.h"
#include "tests/shaders/EditStage.h"
#include "tests/shaders/package/PackageFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

namespace filament_core::shader {
namespace {

using test::fuzzPackage;
using test::withHeader;
using ::testing::HasSubstr;

MaterialPackage fullPackage() {
    MaterialPackage package;
    package.name = "Wet pavement";
    package.blending = Blending::Masked;
    package.culling = Culling::None;
    package.vertexDomain = VertexDomain::World;
    package.doubleSided = true;
    package.depthWrite = false;
    package.maskThreshold = 0.25f;
    package.blendFunction = { .sourceColor = backend::BlendFactor::DstAlpha,
                              .targetAlpha = backend::BlendFactor::SrcAlphaSaturate };
    package.postLightingBlending = PostLightingBlending::Screen;
    package.transparency = TransparencyMode::TwoPassesTwoSides;
    package.interpolation = Interpolation::Flat;
    package.refractionMode = RefractionMode::ScreenSpace;
    package.refractionType = RefractionType::Thin;
    package.reflections = Reflections::ScreenSpace;
    package.quality = MaterialQuality::High;
    package.featureLevel = 3;
    package.alphaToCoverage = package.instanced = package.vertexDomainDeviceJittered = true;
    package.transparentShadow = true;
    package.filteredVariants = kVariantStereo | kVariantHalf;
    package.requiredAttributes = 0b1011;
    package.parameters = { { .name = "tint", .type = ParameterType::Float3 },
                           { .name = "weights", .type = ParameterType::Float, .arraySize = 3 },
                           { .name = "uvMatrix", .type = ParameterType::Float3x3 },
                           { .name = "albedo",
                             .type = ParameterType::Sampler2D,
                             .binding = 1,
                             .format = SamplerFormat::Int,
                             .usedIf = { 0 },
                             .currentPixel = true,
                             .precision = Precision::Medium } };
    package.uniformBytes = assignOffsets(package.parameters);
    package.constants = { { .name = "hasAlbedo", .id = 0 },
                          { .name = "steps", .id = 1, .type = backend::ConstantValue::Type::Int, .defaultBits = 7 } };
    package.terms = { "normal", "clearCoat" };
    package.layout[1].count = 2;
    package.layout[1].bindings[0] = { .binding = 0, .type = backend::BindingType::UniformBuffer };
    package.layout[1].bindings[1] = { .binding = 1, .type = backend::BindingType::SampledTexture };
    package.variants = {
        { .key = 0, .vertex = sharedStage({ { 1, 2 }, "v" }), .fragment = sharedStage({ { 3 }, "f" }) },
        { .key = kVariantSun | kVariantHalf, .fragment = sharedStage({ { 4, 5, 6 }, "sun" }) }
    };
    return package;
}

std::span<const std::byte> sectionsOf(std::span<const std::byte> file) { return file.subspan(format::kHeaderBytes); }

TEST(Package, ReadsBackWhatWasWritten) {
    const MaterialPackage package = fullPackage();
    const Result<MaterialPackage> read = readPackage(writePackage(package));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, package);
}

TEST(Package, KnowsByItsTypeThatATextureHasSeveralSamples) {
    MaterialPackage package = fullPackage();
    package.parameters.push_back({ .name = "samples", .type = ParameterType::Sampler2DMS, .binding = 2 });
    backend::BindGroupLayout& group = package.layout[kGroupMaterial];
    group.count = 2;
    group.bindings[0] = { .binding = 1, .type = backend::BindingType::SampledTexture };
    group.bindings[1] = { .binding = 2, .type = backend::BindingType::SampledTexture, .isMultisampled = true };
    const Result<MaterialPackage> read = readPackage(writePackage(package));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, package);
}

TEST(Package, ReadsBackThePackageWithNothingInIt) {
    const Result<MaterialPackage> read = readPackage(writePackage({}));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, MaterialPackage{});
}

TEST(Package, IsEqualBytesForEqualMaterials) { EXPECT_EQ(writePackage(fullPackage()), writePackage(fullPackage())); }

TEST(Package, SaysByConstantsWhatAVariantHas) {
    const auto values = variantConstants(kVariantSun | kVariantShadowReceiver | kVariantHalf);
    ASSERT_EQ(values.size(), kVariantConstants.size());
    for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(values[i].id, kVariantConstants[i].id);
        EXPECT_EQ(values[i].bits, kVariantConstants[i].bit == kVariantPunctual ? 0u : 1u) << kVariantConstants[i].name;
    }
}

TEST(Package, FindsItsPartsByNameAndKey) {
    const MaterialPackage package = fullPackage();
    EXPECT_EQ(package.findVariant(kVariantSun | kVariantHalf), &package.variants[1]);
    EXPECT_EQ(package.findVariant(kVariantPunctual), nullptr);
    EXPECT_EQ(package.findParameter("albedo"), &package.parameters[3]);
    EXPECT_EQ(package.findParameter("Albedo"), nullptr);
    EXPECT_EQ(package.findConstant("steps"), &package.constants[1]);
    EXPECT_EQ(package.findConstant(""), nullptr);
}

TEST(Package, RefusesEveryTruncation) {
    const std::vector<std::byte> bytes = writePackage(fullPackage());
    for (size_t size = 0; size < bytes.size(); ++size) {
        const auto head = std::span(bytes).first(size);
        EXPECT_FALSE(readPackage(head)) << "cut at " << size;
        if (size < format::kHeaderBytes) continue;
        const Result<MaterialPackage> fixed = readPackage(withHeader(sectionsOf(head)));
        ASSERT_FALSE(fixed) << "cut at " << size;
        EXPECT_EQ(fixed.error().code, ErrorCode::Corrupt);
    }
}

TEST(Package, DetectsEverySingleFlippedBit) {
    std::vector<std::byte> bytes = writePackage(fullPackage());
    for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        const auto mask = std::byte{ 1 } << static_cast<int>(bit % 8);
        bytes[bit / 8] ^= mask;
        EXPECT_FALSE(readPackage(bytes)) << "bit " << bit;
        bytes[bit / 8] ^= mask;
    }
}

TEST(Package, SurvivesRandomMutationsWithAValidChecksum) {
    const std::vector<std::byte> original = writePackage(fullPackage());
    std::mt19937 random(20'000);
    size_t accepted = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::vector<std::byte> bytes(original.begin() + format::kHeaderBytes, original.end());
        for (uint32_t edits = 1 + random() % 4; edits > 0; --edits) {
            const size_t at = random() % bytes.size();
            switch (random() % 4) {
            case 0:
                bytes[at] = static_cast<std::byte>(random());
                break;
            case 1:
                bytes[at] = std::byte{ 0xFF };
                break;
            case 2:
                bytes.erase(bytes.begin() + static_cast<ptrdiff_t>(at));
                break;
            default:
                bytes.insert(bytes.begin() + static_cast<ptrdiff_t>(at), static_cast<std::byte>(random()));
                break;
            }
        }
        accepted += fuzzPackage(bytes);
    }
    EXPECT_GT(accepted, 0u) << "mutations of names and shader text are still packages, so the deep paths were reached";
    EXPECT_LT(accepted, 20'000u);
}

/// The sections by their tags, as far as they are whole.
std::map<uint32_t, std::span<const std::byte>> byTag(std::span<const std::byte> sections) {
    std::map<uint32_t, std::span<const std::byte>> found;
    ByteReader in(sections);
    while (!in.atEnd()) {
        const uint32_t tag = in.u32();
        const auto body = in.bytes(in.u32());
        if (in.failed()) break;
        found.emplace(tag, body);
    }
    return found;
}

/// The sections of a sound package, one of them replaced.
std::vector<std::byte> soundExcept(uint32_t replaced, std::span<const std::byte> body) {
    const std::vector<std::byte> file = writePackage(fullPackage());
    std::vector<std::byte> sections;
    for (auto const& [tag, own] : byTag(sectionsOf(file))) {
        const auto bytes = tag == replaced ? body : own;
        for (const auto word : { tag, static_cast<uint32_t>(bytes.size()) }) {
            const auto header = std::as_bytes(std::span(&word, 1));
            sections.insert(sections.end(), header.begin(), header.end());
        }
        sections.insert(sections.end(), bytes.begin(), bytes.end());
    }
    return sections;
}

// The corpus holds sections without the header, which names the version. Each of its sections also replaces that of a
// sound package: where a new format reads one of them differently, the others are still read to their end.
TEST(Package, OfTheFuzzersCorpusIsReadOrRefused) {
    size_t files = 0, accepted = 0;
    for (auto const& entry : std::filesystem::directory_iterator(tools::sourceDir() / "tests/fuzz/corpus/package")) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::vector<char> read{ std::istreambuf_iterator<char>(file), {} };
        const auto bytes = std::as_bytes(std::span(read));
        fuzzPackage(bytes);
        for (auto const& [tag, body] : byTag(bytes)) accepted += fuzzPackage(soundExcept(tag, body));
        ++files;
    }
    EXPECT_GT(files, 20u);
    EXPECT_GT(accepted, 0u) << "some sections are sound, so that the code behind every check is reached";
}

TEST(Package, SkipsSectionsThatItDoesNotKnow) {
    std::vector<std::byte> bytes = writePackage(fullPackage());
    for (const char letter : { 'N', 'E', 'W', '!' }) bytes.push_back(static_cast<std::byte>(letter));
    for (const int byte : { 2, 0, 0, 0, 9, 9 }) bytes.push_back(static_cast<std::byte>(byte));
    const Result<MaterialPackage> read = readPackage(withHeader(sectionsOf(bytes)));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, fullPackage());
}

TEST(Package, SaysWhichVersionItWouldNeed) {
    std::vector<std::byte> bytes = writePackage(fullPackage());
    bytes[4] = std::byte{ 99 };
    const Result<MaterialPackage> read = readPackage(bytes);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(read.error().message, HasSubstr("version 99"));
}

TEST(Package, NeedsAFractionOfTheBytesForCodeThatRepeatsItself) {
    MaterialPackage package = fullPackage();
    std::string& text = test::editable(package.variants[0].fragment).essl;
    for (int i = 0; i < 2000; ++i) text += "precise highp float _" + std::to_string(i) + " = a * b;\n";
    EXPECT_LT(writePackage(package).size() * 4, text.size());
    EXPECT_EQ(readPackage(writePackage(package)).value(), package);
}

TEST(Package, StoresCodeThatVariantsShareOnce) {
    MaterialPackage package = fullPackage();
    std::mt19937 random(3);
    const auto noise = [&] {
        std::string text(4000, ' ');
        for (char& letter : text) letter = static_cast<char>(random());
        return text;
    };
    package.variants[0].vertex = package.variants[1].vertex = sharedStage({ {}, noise() });
    const size_t shared = writePackage(package).size();
    package.variants[1].vertex = sharedStage({ {}, noise() });
    const size_t apart = writePackage(package).size();
    EXPECT_GT(apart, shared + 3900);
    EXPECT_LT(apart, shared + 4100);
    EXPECT_EQ(readPackage(writePackage(package)).value(), package);
}

TEST(Package, GivesVariantsThatShareAStageOneCopyOfIt) {
    MaterialPackage package = fullPackage();
    package.variants[1].vertex = package.variants[0].vertex;
    const Result<MaterialPackage> read = readPackage(writePackage(package));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->variants[0].vertex, read->variants[1].vertex);
    EXPECT_NE(read->variants[0].fragment, read->variants[1].fragment);
}

TEST(Package, RefusesToMultiplyAPieceOfCodeBeyondReason) {
    MaterialPackage package = fullPackage();
    package.variants.clear();
    for (uint16_t key = 0; key < format::kMaxVariants; ++key) // stages of their own, because their SPIR-V differs
        package.variants.push_back({ .key = key, .vertex = sharedStage({ { key }, std::string(150'000, 'v') }) });
    const Result<MaterialPackage> read = readPackage(writePackage(package));
    ASSERT_FALSE(read) << "77 megabytes from some 10 kilobytes";
    EXPECT_EQ(read.error().code, ErrorCode::Corrupt);
}

TEST(Package, RefusesParametersOutsideOfTheirBlock) {
    MaterialPackage package = fullPackage();
    package.parameters[0].offset = package.uniformBytes;
    EXPECT_FALSE(readPackage(writePackage(package)));
    package = fullPackage();
    package.parameters[1].arraySize = 0x1000'0000; // 2^28 elements of 16 bytes overflow 32 bits
    EXPECT_FALSE(readPackage(writePackage(package)));
}

TEST(Package, RefusesTwoParametersOfTheSameName) {
    MaterialPackage package = fullPackage();
    package.parameters[1].name = package.parameters[0].name;
    const Result<MaterialPackage> read = readPackage(writePackage(package));
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("same name"));
}

// ---------------------------------------------------------------------------------------------- std140

struct Std140Rule {
    ParameterType type;
    uint32_t bytes, alignment, stride;
};

TEST(ParameterLayout, FollowsTheRulesOfStd140) {
    constexpr std::array kRules{
        Std140Rule{ ParameterType::Bool, 4, 4, 16 },       Std140Rule{ ParameterType::Float, 4, 4, 16 },
        Std140Rule{ ParameterType::Float2, 8, 8, 16 },     Std140Rule{ ParameterType::Int3, 12, 16, 16 },
        Std140Rule{ ParameterType::Uint4, 16, 16, 16 },    Std140Rule{ ParameterType::Float3x3, 48, 16, 48 },
        Std140Rule{ ParameterType::Float4x4, 64, 16, 64 }, Std140Rule{ ParameterType::SamplerCube, 0, 0, 0 }
    };
    for (Std140Rule const& rule : kRules) {
        EXPECT_EQ(valueBytes(rule.type), rule.bytes);
        EXPECT_EQ(valueAlignment(rule.type), rule.alignment);
        EXPECT_EQ(arrayStride(rule.type), rule.stride);
    }
}

TEST(ParameterLayout, PlacesAFloatIntoTheGapBehindAFloat3) {
    std::vector<Parameter> parameters{ { .name = "a", .type = ParameterType::Float3 },
                                       { .name = "b", .type = ParameterType::Float },
                                       { .name = "c", .type = ParameterType::Float, .arraySize = 2 },
                                       { .name = "d", .type = ParameterType::Float2 } };
    EXPECT_EQ(assignOffsets(parameters), 64u);
    EXPECT_EQ(parameters[1].offset, 12u);
    EXPECT_EQ(parameters[2].offset, 16u);
    EXPECT_EQ(parameters[3].offset, 48u);
}

} // namespace
} // namespace filament_core::shader

// SPDX-License-Identifier: Apache-2.0
// ETC2, EAC and ASTC, which every OpenGL ES 3.2 implementation samples: filament_core/assets/blocks decodes them
// alike. The engine's formats do not include them, so this test calls OpenGL ES itself.
#include "backend/gles/Api.h"
#include "backend/gles/Context.h"
#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "tests/backend/gles/GlesFixture.h"

#include <array>
#include <cmath>
#include <optional>
#include <random>

namespace filament_core::backend::gles {
namespace {

using SampledTexel = std::array<float, 4>;

constexpr const char* kFetchTexels = R"(#version 310 es
precision highp float;
uniform highp sampler2D image;
out highp uvec4 bits;
void main() { bits = floatBitsToUint(texelFetch(image, ivec2(gl_FragCoord.xy), 0)); }
)";

/// A context of its own.
class RawGles {
public:
    RawGles(Egl const& egl, Context context) : mContext(std::move(context)) { gl.load(egl.GetProcAddress); }
    static std::optional<RawGles> create() {
        const Result<Egl const*> egl = Egl::load();
        if (!egl || (*egl)->displaySources().empty()) return std::nullopt;
        Result<Context> context = Context::create(**egl, (*egl)->displaySources().front(), false);
        if (!context) return std::nullopt;
        return std::optional<RawGles>(std::in_place, **egl, std::move(*context));
    }

    bool has(const char* extension) const {
        return hasExtension(reinterpret_cast<const char*>(gl.GetString(GL_EXTENSIONS)), extension);
    }

    std::vector<SampledTexel> sampled(GLenum format, uint32_t side, std::span<const std::byte> blocks) {
        mContext.makeCurrent();
        const GLuint program = makeProgram();
        const auto size = static_cast<GLsizei>(side);
        std::array<GLuint, 2> textures{};
        gl.GenTextures(2, textures.data());
        GLuint framebuffer = 0, vertexArray = 0;
        gl.GenFramebuffers(1, &framebuffer);
        gl.GenVertexArrays(1, &vertexArray);
        gl.BindTexture(GL_TEXTURE_2D, textures[1]);
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, size, size);
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[1], 0);
        gl.BindTexture(GL_TEXTURE_2D, textures[0]);
        gl.TexStorage2D(GL_TEXTURE_2D, 1, format, size, size);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.CompressedTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size, size, format, static_cast<GLsizei>(blocks.size()),
                                   blocks.data());
        gl.BindVertexArray(vertexArray);
        gl.UseProgram(program);
        gl.Viewport(0, 0, size, size);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<SampledTexel> texels(size_t{ side } * side);
        gl.ReadPixels(0, 0, size, size, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.data());
        EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        gl.DeleteFramebuffers(1, &framebuffer);
        gl.DeleteVertexArrays(1, &vertexArray);
        gl.DeleteTextures(2, textures.data());
        gl.DeleteProgram(program);
        return texels;
    }

private:
    GLuint makeProgram() const {
        const GLuint program = gl.CreateProgram();
        const std::string vertex(kFullScreenVertex);
        for (auto const& [stage, source] : { std::pair<GLenum, const char*>{ GL_VERTEX_SHADER, vertex.c_str() },
                                             std::pair<GLenum, const char*>{ GL_FRAGMENT_SHADER, kFetchTexels } }) {
            const GLuint shader = gl.CreateShader(stage);
            gl.ShaderSource(shader, 1, &source, nullptr);
            gl.CompileShader(shader);
            gl.AttachShader(program, shader);
            gl.DeleteShader(shader);
        }
        gl.LinkProgram(program);
        GLint isLinked = 0;
        gl.GetProgramiv(program, GL_LINK_STATUS, &isLinked);
        EXPECT_TRUE(isLinked);
        return program;
    }

    Context mContext;
    Api gl;
};

std::vector<SampledTexel> decodedTexels(assets::BlockFormat format, uint32_t side, std::span<const std::byte> blocks) {
    const bool isHalf = assets::hasHalfTexels(format.kind);
    std::vector<std::byte> bytes(size_t{ side } * side * (isHalf ? 8 : 4));
    assets::decodeBlocks(format, false, blocks, side, side, bytes);
    std::vector<SampledTexel> texels(size_t{ side } * side);
    for (size_t i = 0; i < texels.size() * 4; ++i) {
        uint16_t half = 0;
        if (isHalf) std::memcpy(&half, &bytes[2 * i], sizeof(half));
        texels[i / 4][i % 4] = isHalf ? floatFromHalf(half) : static_cast<float>(std::to_integer<int>(bytes[i])) / 255;
    }
    return texels;
}

std::vector<std::byte> randomBytes(uint64_t count) {
    std::mt19937 random(5);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
}

struct SampledFormat {
    GLenum gl;
    assets::BlockFormat format;
    float tolerance; ///< what the decoder's 8 bits or halves do not hold
};

/// Blocks of one colour whose extents are not valid are undefined: there are none.
std::vector<std::byte> randomBlocksOf(assets::BlockFormat format, uint32_t side) {
    std::vector<std::byte> bytes = randomBytes(bytesOfBlocks(format, side, side));
    for (size_t at = 0; format.kind == assets::BlockKind::Astc && at < bytes.size(); at += 16) {
        if (bytes[at] == std::byte{ 0xFC } && (bytes[at + 1] & std::byte{ 1 }) != std::byte{ 0 }) bytes[at] = {};
    }
    return bytes;
}

void expectSampledAlike(RawGles& gles, SampledFormat const& one, uint32_t side) {
    const std::vector<std::byte> blocks = randomBlocksOf(one.format, side);
    const auto device = gles.sampled(one.gl, side, blocks), ours = decodedTexels(one.format, side, blocks);
    for (size_t i = 0; i < ours.size(); ++i) {
        for (size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(device[i][c], ours[i][c], one.tolerance)
                    << std::hex << one.gl << std::dec << ": texel " << i % side << ", " << i / side << " channel " << c;
    }
}

TEST(GlesBlockSampling, Etc2AndEacAreDecodedToTheirBits) {
    std::optional<RawGles> gles = RawGles::create();
    if (!gles)
        GTEST_SKIP() << "no OpenGL ES device here to compare the decoder with; its closed forms are in "
                        "tests/filament_core/assets";
    using enum assets::BlockKind;
    constexpr float kBits = 1e-6f, kHalf = 1.0f / 2048; // a half has 11 bits above 0.5
    for (SampledFormat const& one : { SampledFormat{ GL_COMPRESSED_RGB8_ETC2, { Etc2Rgb }, kBits },
                                      { GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2, { Etc2RgbA1 }, kBits },
                                      { GL_COMPRESSED_RGBA8_ETC2_EAC, { Etc2Rgba }, kBits },
                                      { GL_COMPRESSED_R11_EAC, { EacR }, kHalf },
                                      { GL_COMPRESSED_SIGNED_R11_EAC, { EacRSigned }, kHalf },
                                      { GL_COMPRESSED_RG11_EAC, { EacRg }, kHalf },
                                      { GL_COMPRESSED_SIGNED_RG11_EAC, { EacRgSigned }, kHalf } })
        expectSampledAlike(*gles, one, 256);
}

TEST(GlesBlockSampling, AstcOfEverySizeIsDecodedToTheHighest8BitsOfItsNumbers) {
    std::optional<RawGles> gles = RawGles::create();
    if (!gles)
        GTEST_SKIP() << "no OpenGL ES device here to compare the decoder with; its closed forms are in "
                        "tests/filament_core/assets";
    if (!gles->has("GL_KHR_texture_compression_astc_ldr"))
        GTEST_SKIP() << "this device samples no ASTC, which is optional: there is nothing to compare the decoder with";
    for (size_t i = 0; i < assets::kAstcBlockSizes.size(); ++i) {
        const auto gl = static_cast<GLenum>(GL_COMPRESSED_RGBA_ASTC_4x4_KHR + i);
        expectSampledAlike(*gles,
                           { gl,
                             { assets::BlockKind::Astc, assets::kAstcBlockSizes[i][0], assets::kAstcBlockSizes[i][1] },
                             1.1f / 255 },
                           240);
    }
}

} // namespace
} // namespace filament_core::backend::gles

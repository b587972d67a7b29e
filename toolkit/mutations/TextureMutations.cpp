// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Edits.h"

#include "shaders/interface/ShaderInterface.h"

#include <algorithm>
#include <bit>

namespace filament_core::tools {
namespace {

class SrgbDroppedEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreateTexture& command) override {
        if (command.desc.format == Format::RGBA8Srgb) command.desc.format = Format::RGBA8;
    }
};

/// Changes one code of one texel of a mip level by one, in textures with one layer and four bytes per texel.
class MipTexelEdit final : public PayloadEdit {
public:
    MipTexelEdit(uint32_t level, uint32_t texel) : mLevel(level), mTexel(texel) {}

    using PayloadEdit::edit;
    void edit(CmdUploadTexture& command) override {
        const bool isSmallest = command.level > 0 && command.rect.width == 1 && command.rect.height == 1;
        if (mLevel == kSmallestLevel ? !isSmallest : command.level != mLevel) return;
        const size_t at = size_t{ mTexel } * 4;
        if (at < command.bytes.size()) copy(command.bytes)[at] ^= std::byte{ 1 };
    }

private:
    uint32_t mLevel, mTexel;
};

class MipBiasEdit final : public PayloadEdit {
public:
    using PayloadEdit::edit;
    void edit(CmdCreateProgram& command) override {
        const std::span words(reinterpret_cast<const uint32_t*>(command.desc.fragment.data()),
                              command.desc.fragment.size() / sizeof(uint32_t));
        const std::vector<uint32_t> biased = withMipBias(words, 0.5f);
        std::span<const std::byte> bytes = std::as_bytes(std::span(biased));
        copy(bytes);
        command.desc.fragment = bytes;
    }
};

/// Textures are read at the mip levels of the pixels that are drawn.
class DrawnLevelsEdit final : public ConstantEdit {
    void editConstant(std::string_view, ConstantValue& constant) const override {
        if (constant.id == shader::kQualityMipBias) constant.bits = 0;
    }
};

class WrapModeEdit final : public StreamEdit {
public:
    using StreamEdit::edit;
    void edit(CmdCreateSampler& command) override {
        for (WrapMode* wrap : { &command.desc.wrapU, &command.desc.wrapV }) {
            if (*wrap == WrapMode::Repeat) *wrap = WrapMode::MirroredRepeat;
        }
    }
};

std::unique_ptr<StreamEdit> lastMip() { return mipTexelEdit(kSmallestLevel, 0); }

constexpr Mutation kTextureMutations[] = {
    { "srgb", "sRGB decoding dropped", make<SrgbDroppedEdit> },
    { "mipBias", "mip bias + 0.5", make<MipBiasEdit>, Backend::Vulkan },
    { "lastMip", "one code of the smallest mip level one off", lastMip },
    { "wrapMode", "repeating textures mirrored", make<WrapModeEdit> },
    { "drawnLevels", "textures at the mip levels of the pixels that are drawn", make<DrawnLevelsEdit> },
};

} // namespace

std::span<const Mutation> textureMutations() { return kTextureMutations; }

std::unique_ptr<StreamEdit> mipTexelEdit(uint32_t level, uint32_t texel) {
    return std::make_unique<MipTexelEdit>(level, texel);
}

// SPIR-V 1.6 specification: 2.3 (instructions), 3.14 (image operands; Bias is bit 0 and so its operand comes first).
std::vector<uint32_t> withMipBias(std::span<const uint32_t> module, float bias) {
    constexpr uint32_t kHeader = 5, kOpTypeFloat = 22, kOpConstant = 43, kOpImageSampleImplicitLod = 87, kBias = 1;
    std::vector<uint32_t> result(module.begin(), module.begin() + std::min<size_t>(kHeader, module.size()));
    if (module.size() < kHeader) return result;
    const uint32_t constant = result[3]++; // a new id within the bound
    for (size_t at = kHeader; at < module.size();) {
        const uint32_t words = module[at] >> 16, op = module[at] & 0xFFFF;
        if (words == 0 || at + words > module.size()) break;
        std::vector<uint32_t> instruction(module.begin() + at, module.begin() + at + words);
        const bool hasMask = words > 5;
        if (op == kOpImageSampleImplicitLod && !(hasMask && instruction[5] & kBias)) {
            if (!hasMask) instruction.push_back(0);
            instruction[5] |= kBias;
            instruction.insert(instruction.begin() + 6, constant);
            instruction[0] = static_cast<uint32_t>(instruction.size()) << 16 | op;
        }
        result.insert(result.end(), instruction.begin(), instruction.end());
        if (op == kOpTypeFloat && words == 3 && instruction[2] == 32)
            result.insert(result.end(),
                          { 4u << 16 | kOpConstant, instruction[1], constant, std::bit_cast<uint32_t>(bias) });
        at += words;
    }
    return result;
}

} // namespace filament_core::tools

// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/CheckSpirv.h"

#include "shaders/package/GroupLayouts.h"

#include <spirv-tools/libspirv.hpp>
#include <spirv_cross/spirv.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace filament_core::engine {
namespace {

using Words = std::vector<uint32_t>;

constexpr uint64_t kMaxTypeBytes = 1u << 20;

/// Requirements of a valid module.
class Module {
public:
    explicit Module(Words const& words) {
        constexpr size_t kHeader = 5;
        for (size_t at = kHeader; at < words.size();) {
            const size_t count = std::max<size_t>(words[at] >> 16, 1);
            read(static_cast<spv::Op>(words[at] & 0xFFFF), std::span(words).subspan(at, count));
            at += count;
        }
    }

    /// Empty: everything that it names is in `layout`.
    std::string outside(backend::ProgramLayout const& layout) const {
        for (auto const& [id, place] : mPlaces) {
            const uint32_t set = place.first, binding = place.second;
            const auto isIt = [&](backend::BindingDesc const& desc) { return desc.binding == binding; };
            const bool isKnown = set < layout.size() &&
                                 std::ranges::any_of(std::span(layout[set].bindings).first(layout[set].count), isIt);
            if (!isKnown)
                return fmt::format("it uses binding {} of group {}, which the package does not have", binding, set);
        }
        return {};
    }

    spv::ExecutionModel stage() const { return mStage; }
    bool hasMain() const { return mHasMain; }
    uint64_t largestType() const { return mLargestType; }

private:
    void read(spv::Op op, std::span<const uint32_t> words) {
        if (op == spv::OpEntryPoint) {
            mStage = static_cast<spv::ExecutionModel>(words[1]);
            mHasMain = std::string_view(reinterpret_cast<const char*>(words.data() + 3)) == "main";
        }
        if (op == spv::OpDecorate && words[2] == spv::DecorationDescriptorSet) mPlaces[words[1]].first = words[3];
        if (op == spv::OpDecorate && words[2] == spv::DecorationBinding) mPlaces[words[1]].second = words[3];
        if (op == spv::OpConstant && words.size() == 4) mConstants[words[2]] = words[3];
        readType(op, words);
    }

    // An upper bound: every scalar counts 8 bytes.
    void readType(spv::Op op, std::span<const uint32_t> words) {
        uint64_t bytes = 0;
        if (op == spv::OpTypeFloat || op == spv::OpTypeInt || op == spv::OpTypeBool) bytes = 8;
        if (op == spv::OpTypeVector || op == spv::OpTypeMatrix) bytes = mSizes[words[2]] * words[3];
        if (op == spv::OpTypeArray) bytes = mSizes[words[2]] * mConstants[words[3]];
        if (op == spv::OpTypeStruct) {
            for (const uint32_t member : words.subspan(2)) bytes += mSizes[member];
        }
        if (bytes == 0) return;
        mSizes[words[1]] = bytes = std::min(bytes, uint64_t{ 1 } << 40);
        mLargestType = std::max(mLargestType, bytes);
    }

    std::map<uint32_t, std::pair<uint32_t, uint32_t>> mPlaces; ///< by id: group and binding
    std::map<uint32_t, uint64_t> mConstants, mSizes;
    spv::ExecutionModel mStage = spv::ExecutionModelMax;
    bool mHasMain = false;
    uint64_t mLargestType = 0;
};

/// Empty: a driver may see it.
std::string faultOf(Words const& words, spv::ExecutionModel stage, backend::ProgramLayout const& layout) {
    std::string complaint;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, spv_position_t const&, const char* text) {
        if (complaint.empty()) complaint = text;
    });
    // First: the walk below relies on a valid module.
    if (!tools.Validate(words.data(), words.size())) return complaint.empty() ? "it is not valid" : complaint;
    const Module module(words);
    if (module.stage() != stage || !module.hasMain()) return "it has no 'main' of this stage";
    if (module.largestType() > kMaxTypeBytes) return fmt::format("a type is larger than {} bytes", kMaxTypeBytes);
    return module.outside(layout);
}

} // namespace

Result<void> checkSpirv(shader::MaterialPackage const& package) {
    std::vector<std::pair<Words const*, backend::ProgramLayout>> checked; // variants share code
    const auto isChecked = [&](Words const& words, backend::ProgramLayout const& layout) {
        return std::ranges::any_of(checked,
                                   [&](auto const& known) { return known.first == &words && known.second == layout; });
    };
    for (shader::Variant const& variant : package.variants) {
        const backend::ProgramLayout layout = shader::programLayout(package, variant.key);
        for (const bool isVertex : { true, false }) {
            Words const& words = isVertex ? variant.vertex->spirv : variant.fragment->spirv;
            if (words.empty() || isChecked(words, layout)) continue; // empty: a package for OpenGL ES only
            checked.emplace_back(&words, layout);
            const auto stage = isVertex ? spv::ExecutionModelVertex : spv::ExecutionModelFragment;
            if (const std::string fault = faultOf(words, stage, layout); !fault.empty())
                return fail(ErrorCode::Corrupt,
                            "variant {}: the SPIR-V of the {} stage is damaged: {}; compile it again", variant.key,
                            isVertex ? "vertex" : "fragment", fault);
        }
    }
    return {};
}

} // namespace filament_core::engine

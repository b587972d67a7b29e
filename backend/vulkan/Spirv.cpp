// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Spirv.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace filament_core::backend::vulkan {
namespace {

constexpr uint32_t kMagic = 0x07230203;
constexpr size_t kHeaderWords = 5;
constexpr uint32_t kMaxIds = 0x3FFFFF; // universal limit on the id bound, section 2.17
constexpr uint32_t kMaxLocations = 32;

enum Op : uint32_t {
    OpEntryPoint = 15,
    OpTypeInt = 21,
    OpTypeFloat = 22,
    OpTypeVector = 23,
    OpTypeMatrix = 24,
    OpTypeArray = 28,
    OpTypePointer = 32,
    OpConstant = 43,
    OpVariable = 59,
    OpDecorate = 71,
};
constexpr uint32_t kDecorationLocation = 30;
constexpr uint32_t kStorageInput = 1, kStorageOutput = 3;

struct Id {
    uint32_t op = 0;
    uint32_t type = 0;  // pointee, element or column type; a variable's pointer type
    uint32_t value = 0; // storage class, count, signedness, constant
    int32_t location = -1;
};

/// The facts about ids that the edges depend on.
class Module {
public:
    explicit Module(ShaderStage stage) : mExecutionModel(executionModel(stage)) {}

    Result<void> read(std::span<const uint32_t> words) {
        if (words.size() < kHeaderWords || words[0] != kMagic) return fail(ErrorCode::Corrupt, "not a SPIR-V module");
        if (words[3] > kMaxIds) return fail(ErrorCode::Corrupt, "SPIR-V id bound {} is beyond the limit", words[3]);
        mIds.resize(words[3]);
        for (size_t at = kHeaderWords; at < words.size();) {
            const size_t count = words[at] >> 16;
            if (count == 0 || count > words.size() - at) {
                return fail(ErrorCode::Corrupt, "SPIR-V instruction at word {} runs past the end", at);
            }
            readInstruction(words[at] & 0xFFFF, words.subspan(at + 1, count - 1));
            at += count;
        }
        if (!mHasEntryPoint) return fail(ErrorCode::Corrupt, "SPIR-V module has no entry point 'main' for this stage");
        return {};
    }

    ShaderEdges edges() const {
        ShaderEdges edges;
        for (Id const& variable : mIds) {
            if (variable.op != OpVariable || variable.location < 0) continue;
            const uint32_t type = typeOf(variable.type).type; // the pointee
            const auto first = static_cast<uint32_t>(variable.location);
            const uint32_t end = std::min(first + locationCount(type, 0), kMaxLocations);
            for (uint32_t location = first; location < end; ++location) {
                if (variable.value == kStorageInput) edges.inputs.push_back({ location, scalarKind(type) });
                if (variable.value == kStorageOutput) edges.outputMask |= 1u << location;
            }
        }
        std::ranges::sort(edges.inputs, {}, &ShaderInput::location);
        // Merges the components of one location.
        const auto isSame = [](ShaderInput const& a, ShaderInput const& b) { return a.location == b.location; };
        edges.inputs.erase(std::unique(edges.inputs.begin(), edges.inputs.end(), isSame), edges.inputs.end());
        return edges;
    }

private:
    static uint32_t executionModel(ShaderStage stage) { // section 3.3
        return stage == ShaderStage::Vertex ? 0 : stage == ShaderStage::Fragment ? 4 : 5;
    }

    void readInstruction(uint32_t op, std::span<const uint32_t> operands) {
        const auto operand = [&](size_t i) { return i < operands.size() ? operands[i] : 0; };
        switch (op) {
        case OpEntryPoint:
            mHasEntryPoint |= operand(0) == mExecutionModel && isMain(operands);
            break;
        case OpTypeInt:
            define(operand(0), { op, 0, operand(2) });
            break;
        case OpTypeFloat:
            define(operand(0), { op, 0, 0 });
            break;
        case OpTypeVector:
        case OpTypeMatrix:
        case OpTypeArray:
            define(operand(0), { op, operand(1), operand(2) });
            break;
        case OpTypePointer:
            define(operand(0), { op, operand(2), operand(1) });
            break;
        case OpConstant:
        case OpVariable:
            define(operand(1), { op, operand(0), operand(2) });
            break;
        case OpDecorate:
            if (operand(1) == kDecorationLocation && operand(0) < mIds.size() && operand(2) < kMaxLocations) {
                mIds[operand(0)].location = static_cast<int32_t>(operand(2));
            }
            break;
        default:
            break;
        }
    }

    static bool isMain(std::span<const uint32_t> operands) {
        if (operands.size() < 4) return false; // model, function, "main" and its terminating zero
        return std::memcmp(&operands[2], "main", 5) == 0;
    }

    /// Decorations precede definitions: remember the location.
    void define(uint32_t id, Id const& facts) {
        if (id >= mIds.size()) return;
        const int32_t location = mIds[id].location;
        mIds[id] = facts;
        mIds[id].location = location;
    }

    Id const& typeOf(uint32_t id) const {
        static const Id kNothing;
        return id < mIds.size() ? mIds[id] : kNothing;
    }

    // The depth is limited, because a broken module may define a type in terms of itself.
    static constexpr int kMaxDepth = 8;

    uint32_t locationCount(uint32_t id, int depth) const {
        Id const& type = typeOf(id);
        if (depth == kMaxDepth || (type.op != OpTypeMatrix && type.op != OpTypeArray)) return 1;
        const uint32_t count =
                type.op == OpTypeMatrix ? type.value : typeOf(type.value).value; // arrays: a constant's id
        return std::min(std::min(count, kMaxLocations) * locationCount(type.type, depth + 1), kMaxLocations);
    }

    ScalarKind scalarKind(uint32_t id) const {
        for (int depth = 0; depth < kMaxDepth; ++depth) {
            Id const& type = typeOf(id);
            if (type.op == OpTypeInt) return type.value != 0 ? ScalarKind::Int : ScalarKind::UInt;
            if (type.op != OpTypeVector && type.op != OpTypeMatrix && type.op != OpTypeArray) break;
            id = type.type;
        }
        return ScalarKind::Float;
    }

    uint32_t mExecutionModel;
    bool mHasEntryPoint = false;
    std::vector<Id> mIds;
};

} // namespace

Result<ShaderEdges> readEdges(std::span<const uint32_t> words, ShaderStage stage) {
    Module module(stage);
    if (Result<void> read = module.read(words); !read) return read.error();
    return module.edges();
}

} // namespace filament_core::backend::vulkan

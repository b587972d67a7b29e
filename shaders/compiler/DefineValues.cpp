// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/DefineValues.h"

#include "shaders/compiler/SpirvWords.h"

#include <map>

namespace filament_core::shader {
namespace {

bool isUnset(spv::Op op, std::span<const uint32_t> words) {
    const bool isLocal =
            op == spv::OpVariable && (words[3] == spv::StorageClassFunction || words[3] == spv::StorageClassPrivate);
    return isLocal && words.size() == 4;
}

/// Adds OpConstantNull before the first function or global variable, and names it in every unset variable.
class Initializer {
public:
    explicit Initializer(std::span<const uint32_t> module) : mModule(module), mBound(module[kModuleBoundWord]) {}

    std::vector<uint32_t> run() {
        forEachInstruction(mModule, [&](spv::Op op, std::span<const uint32_t> words) {
            if (op == spv::OpTypePointer) mPointees[words[1]] = words[3];
        });
        mOut.assign(mModule.begin(), mModule.begin() + kModuleHeaderWords);
        forEachInstruction(mModule, [&](spv::Op op, std::span<const uint32_t> words) {
            if (op == spv::OpFunction && !mInFunctions) startFunctions();
            if (!isUnset(op, words)) {
                mOut.insert(mOut.end(), words.begin(), words.end());
                return;
            }
            const uint32_t zero = zeroOf(mPointees.at(words[1])); // may add it to mOut
            mOut.insert(mOut.end(), { 5u << 16 | op, words[1], words[2], words[3], zero });
        });
        mOut[kModuleBoundWord] = mBound;
        return std::move(mOut);
    }

private:
    /// The zeros of all local variables, before the first function.
    void startFunctions() {
        mInFunctions = true;
        forEachInstruction(mModule, [&](spv::Op op, std::span<const uint32_t> words) {
            if (isUnset(op, words)) zeroOf(mPointees.at(words[1]));
        });
    }

    uint32_t zeroOf(uint32_t type) {
        uint32_t& zero = mZeros[type];
        if (zero == 0) {
            zero = mBound++;
            mOut.insert(mOut.end(), { 3u << 16 | spv::OpConstantNull, type, zero });
        }
        return zero;
    }

    std::span<const uint32_t> mModule;
    uint32_t mBound = 0;
    bool mInFunctions = false;
    std::map<uint32_t, uint32_t> mPointees, mZeros; ///< by type id
    std::vector<uint32_t> mOut;
};

} // namespace

std::vector<uint32_t> initializeVariables(std::span<const uint32_t> spirv) { return Initializer(spirv).run(); }

} // namespace filament_core::shader

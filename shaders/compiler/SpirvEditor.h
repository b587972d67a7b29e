// SPDX-License-Identifier: Apache-2.0
/// SpirvEditor: reads a SPIR-V module and writes it again, replacing single instructions by several.
///   In      a valid module (of glslang or SPIRV-Tools); the words must outlive the editor.
///   Out     rewrite(): the new module; ids of results keep their numbers, names and decorations.
///   Thread  one at a time. Memory: a table by id and the new words.
///   Limits  knows the types of values and 32-bit float constants; everything else is copied unchanged.
///   Fails   never for a valid module; FILAMENT_ASSERT for a truncated one.
#pragma once

#include "shaders/compiler/SpirvWords.h"

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace filament_core::shader {

class SpirvEditor {
public:
    using Id = SpirvId;

    struct Instruction {
        spv::Op op = spv::OpNop;
        Id type = 0, result = 0;            ///< 0 if the instruction has none
        std::span<const uint32_t> operands; ///< after type and result
    };

    explicit SpirvEditor(std::span<const uint32_t> module);

    /// Emits code for the instruction and returns the id of its value; 0 keeps the instruction.
    using Replace = std::function<Id(Instruction const&)>;
    /// Offers every instruction inside functions to `replace`, in order.
    std::vector<uint32_t> rewrite(Replace const& replace);

    // ---- queries
    Id typeOf(Id value) const;
    bool isFloat32(Id type) const; ///< scalar, vector or matrix of 32-bit floats
    bool isVector(Id type) const;
    uint32_t elementCount(Id type) const; ///< components of a vector, columns of a matrix, 1 of a scalar
    Id elementType(Id type) const;        ///< of a vector: its scalar; of a matrix: its column; of a scalar: itself
    /// Components of a 32-bit float constant; empty for everything else.
    std::span<const float> constantOf(Id value) const;
    /// An integer constant, or a vector of such, that is nowhere 0.
    bool isNonZeroInteger(Id value) const;
    /// Depends only on constants and specialisation constants, so the driver knows it when it compiles.
    bool isConstantExpression(Id value) const;
    bool isPlane(Id image) const;    ///< a sampled image that is flat, or an array of such: neither a cube nor a volume
    Id extendedInstructions() const; ///< the GLSL.std.450 import; 0: none
    bool isExtended(Instruction const& at) const; ///< an OpExtInst of GLSL.std.450

    // ---- inside `replace`
    Id emit(spv::Op op, Id type, std::span<const uint32_t> operands);
    Id emit(spv::Op op, Id type, std::initializer_list<uint32_t> operands);
    Id constant(std::span<const float> components, Id type); ///< a scalar or vector constant, made once
    Id splat(float value, Id type);
    Id splatBits(uint32_t value, Id type); ///< of 32-bit integers
    Id boolTypeLike(Id type);              ///< bool, or a vector of as many bools

private:
    struct Type {
        spv::Op op = spv::OpNop;
        Id element = 0;
        uint32_t count = 0; ///< vectors, matrices: elements; scalars: bits
    };

    void scan();
    void scanGlobal(Instruction const& at);
    void scanConstant(Instruction const& at);
    bool followsFromConstants(Instruction const& at) const;
    Instruction instructionAt(size_t word) const;
    size_t wordCountAt(size_t word) const;
    void copyOrReplace(size_t word, Replace const& replace);
    void renameLast(Id last, Id result, Id type);
    void inheritDecorations(Id from);
    Id newId(Id type);
    Id makeConstant(std::vector<uint32_t> const& words, Id type);
    Id findOrMakeType(spv::Op op, Id element, uint32_t count);

    std::span<const uint32_t> mModule;
    size_t mGlobals = 0;   ///< word index after the annotations
    size_t mFunctions = 0; ///< word index of the first function
    std::vector<Id> mTypeOf;
    std::unordered_map<Id, Type> mTypes;
    std::unordered_map<Id, std::vector<float>> mConstants;
    std::unordered_set<Id> mNonZeroIntegers;
    std::unordered_set<Id> mConstantExpressions;
    std::unordered_set<Id> mPlanes; ///< types of flat images, and of these with a sampler
    std::unordered_map<Id, std::vector<spv::Decoration>> mPrecision; ///< RelaxedPrecision, NoContraction
    std::map<std::pair<Id, std::vector<uint32_t>>, Id> mMadeConstants;
    Id mExtended = 0;

    std::vector<uint32_t> mNewAnnotations, mNewGlobals, mBody;
    std::vector<Id> mEmitted; ///< for the instruction being replaced
    size_t mLastEmitted = 0;  ///< word index in mBody
};

} // namespace filament_core::shader

// SPDX-License-Identifier: Apache-2.0
/// Value: a 32-bit float scalar, vector or matrix of the module being edited. Its operators emit instructions, so that
/// a C++ formula becomes the same formula in the shader, operation by operation, in the order written.
///   Thread  that of the editor. Fails: never.
#pragma once

#include "shaders/compiler/SpirvEditor.h"

#include <spirv_cross/GLSL.std.450.h>

#include <initializer_list>
#include <span>
#include <vector>

namespace filament_core::shader {

struct Value {
    SpirvEditor* editor = nullptr;
    SpirvEditor::Id id = 0;

    SpirvEditor::Id type() const { return editor->typeOf(id); }
    uint32_t size() const { return editor->elementCount(type()); }
    bool isVector() const { return editor->isVector(type()); }
    Value operator[](uint32_t element) const; ///< component of a vector, column of a matrix
    Value like(float value) const;            ///< the constant, as wide as this
};

Value operator+(Value a, Value b); ///< equal types
Value operator-(Value a, Value b);
Value operator*(Value a, Value b); ///< component by component, or a vector times a scalar on either side
Value operator/(Value a, Value b);
Value operator-(Value a);
Value operator+(float a, Value b);
Value operator-(float a, Value b);
Value operator*(float a, Value b);
Value operator-(Value a, float b);
Value operator/(float a, Value b);

/// One instruction of GLSL.std.450 whose result has the type of the first argument.
Value call(GLSLstd450 function, std::initializer_list<Value> arguments);
Value compose(SpirvEditor::Id type, std::span<const Value> parts);
Value repeat(Value scalar, SpirvEditor::Id type); ///< the scalar in every component of a vector type
/// a < b component by component; scalars a and b choose a whole vector.
Value selectLess(Value a, Value b, Value ifLess, Value otherwise);
Value dot(Value a, Value b);             ///< ((x + y) + z) + w
Value sum(std::span<const Value> terms); ///< left to right

} // namespace filament_core::shader

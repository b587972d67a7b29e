// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/SpirvMath.h"

namespace filament_core::shader {
namespace {

Value binary(spv::Op op, Value a, Value b) { return { a.editor, a.editor->emit(op, a.type(), { a.id, b.id }) }; }

} // namespace

Value Value::operator[](uint32_t element) const {
    return { editor, editor->emit(spv::OpCompositeExtract, editor->elementType(type()), { id, element }) };
}

Value Value::like(float value) const { return { editor, editor->splat(value, type()) }; }

Value operator+(Value a, Value b) { return binary(spv::OpFAdd, a, b); }
Value operator-(Value a, Value b) { return binary(spv::OpFSub, a, b); }
Value operator/(Value a, Value b) { return binary(spv::OpFDiv, a, b); }
Value operator-(Value a) { return { a.editor, a.editor->emit(spv::OpFNegate, a.type(), { a.id }) }; }

Value operator*(Value a, Value b) {
    if (a.isVector() == b.isVector()) return binary(spv::OpFMul, a, b);
    return a.isVector() ? binary(spv::OpVectorTimesScalar, a, b) : binary(spv::OpVectorTimesScalar, b, a);
}

Value operator+(float a, Value b) { return b.like(a) + b; }
Value operator-(float a, Value b) { return b.like(a) - b; }
Value operator*(float a, Value b) { return b.like(a) * b; }
Value operator-(Value a, float b) { return a - a.like(b); }
Value operator/(float a, Value b) { return b.like(a) / b; }

Value call(GLSLstd450 function, std::initializer_list<Value> arguments) {
    SpirvEditor& editor = *arguments.begin()->editor;
    std::vector<uint32_t> operands{ editor.extendedInstructions(), static_cast<uint32_t>(function) };
    for (Value const& argument : arguments) operands.push_back(argument.id);
    return { &editor, editor.emit(spv::OpExtInst, arguments.begin()->type(), operands) };
}

Value compose(SpirvEditor::Id type, std::span<const Value> parts) {
    std::vector<uint32_t> operands;
    for (Value const& part : parts) operands.push_back(part.id);
    SpirvEditor& editor = *parts[0].editor;
    return { &editor, editor.emit(spv::OpCompositeConstruct, type, operands) };
}

Value repeat(Value scalar, SpirvEditor::Id type) {
    const std::vector<Value> parts(scalar.editor->elementCount(type), scalar);
    return compose(type, parts);
}

Value selectLess(Value a, Value b, Value ifLess, Value otherwise) {
    SpirvEditor& editor = *a.editor;
    uint32_t condition = editor.emit(spv::OpFOrdLessThan, editor.boolTypeLike(a.type()), { a.id, b.id });
    if (ifLess.isVector() && !a.isVector()) { // SPIR-V 1.3 needs one condition per component
        const std::vector<uint32_t> conditions(ifLess.size(), condition);
        condition = editor.emit(spv::OpCompositeConstruct, editor.boolTypeLike(ifLess.type()), conditions);
    }
    return { &editor, editor.emit(spv::OpSelect, ifLess.type(), { condition, ifLess.id, otherwise.id }) };
}

Value sum(std::span<const Value> terms) {
    Value total = terms[0];
    for (Value const& term : terms.subspan(1)) total = total + term;
    return total;
}

Value dot(Value a, Value b) {
    const Value products = a * b;
    if (!products.isVector()) return products;
    std::vector<Value> terms;
    for (uint32_t i = 0; i < products.size(); ++i) terms.push_back(products[i]);
    return sum(terms);
}

} // namespace filament_core::shader

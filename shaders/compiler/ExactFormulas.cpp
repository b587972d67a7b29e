// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ExactFormulas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

namespace filament_core::shader {

// ---------------------------------------------------------------------------------------------- geometry, blending

Value exactLength(Value v) { return v.isVector() ? call(GLSLstd450Sqrt, { dot(v, v) }) : call(GLSLstd450FAbs, { v }); }

Value exactNormalize(Value v) {
    if (!v.isVector()) return call(GLSLstd450FSign, { v });
    const Value square = dot(v, v); // raised, so that a zero vector stays zero
    const Value raised = call(GLSLstd450FMax, { square, square.like(std::numeric_limits<float>::min()) });
    return v * call(GLSLstd450InverseSqrt, { raised });
}

Value exactReflect(Value incident, Value normal) { return incident - normal * (2.0f * dot(normal, incident)); }

Value exactRefract(Value incident, Value normal, Value eta) {
    const Value cosine = dot(normal, incident);
    const Value k = 1.0f - (eta * eta) * (1.0f - cosine * cosine);
    const Value root = call(GLSLstd450Sqrt, { call(GLSLstd450FMax, { k, k.like(0.0f) }) });
    const Value bent = incident * eta - normal * (eta * cosine + root);
    return selectLess(k, k.like(0.0f), incident.like(0.0f), bent); // total internal reflection
}

Value exactCross(Value a, Value b) {
    const Value parts[] = { a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1] };
    return compose(a.type(), parts);
}

Value exactFaceForward(Value normal, Value incident, Value reference) {
    const Value facing = dot(reference, incident);
    return selectLess(facing, facing.like(0.0f), normal, -normal);
}

Value exactMix(Value a, Value b, Value t) { return a + (b - a) * t; }

Value exactSmoothStep(Value edge0, Value edge1, Value x) {
    const auto low = edge0.editor->constantOf(edge0.id), high = edge0.editor->constantOf(edge1.id);
    Value width = edge1;
    if (!low.empty() && low.size() == high.size()) { // treat a constant width like any other constant divisor
        std::vector<float> difference(low.size());
        std::ranges::transform(high, low, difference.begin(), [](float b, float a) { return b - a; });
        width.id = edge1.editor->constant(difference, edge1.type());
    } else {
        width = edge1 - edge0;
    }
    const Value ratio = exactDivide(x - edge0, width);
    const Value t = call(GLSLstd450FMin, { call(GLSLstd450FMax, { ratio, x.like(0.0f) }), x.like(1.0f) });
    return (t * t) * (3.0f - 2.0f * t);
}

Value exactMod(Value x, Value y) { return x - y * call(GLSLstd450Floor, { exactDivide(x, y) }); }

Value exactDivide(Value x, Value y) {
    const std::span<const float> divisor = y.editor->constantOf(y.id);
    if (divisor.empty()) {
        // To the driver, an expression of specialisation constants is a constant: multiply by the reciprocal here, too.
        return y.editor->isConstantExpression(y.id) ? x * (1.0f / y) : x / y;
    }
    std::vector<float> reciprocal(divisor.size());
    std::ranges::transform(divisor, reciprocal.begin(), [](float value) { return 1.0f / value; });
    return x * Value{ y.editor, y.editor->constant(reciprocal, y.type()) };
}

namespace {

constexpr int kLargestProduct = 8;

bool isSmallWhole(float exponent) { return std::abs(exponent) <= kLargestProduct && exponent == std::trunc(exponent); }

/// x^n in at most four multiplications, n in [0, 8].
Value product(Value x, int n) {
    if (n == 0) return x.like(1.0f);
    Value power = x, result{};
    for (int bit = 1; bit <= n; bit *= 2, power = bit <= n ? power * power : power) {
        if ((n & bit) != 0) result = result.editor ? power * result : power;
    }
    return result;
}

Value wholePower(Value x, float exponent) {
    const Value power = product(x, static_cast<int>(std::abs(exponent)));
    return exponent < 0.0f ? 1.0f / power : power;
}

/// The driver knows the exponent when it compiles, and Mesa's GLSL compiler then replaces 1, 2 and 4 by products.
Value powSpecialised(Value x, Value exponent) {
    SpirvEditor& editor = *x.editor;
    Value result = call(GLSLstd450Pow, { x, exponent });
    for (const float n : { 1.0f, 2.0f, 3.0f, 4.0f }) {
        const auto isN = editor.emit(spv::OpFOrdEqual, editor.boolTypeLike(x.type()), { exponent.id, x.like(n).id });
        result.id = editor.emit(spv::OpSelect, x.type(), { isN, wholePower(x, n).id, result.id });
    }
    return result;
}

} // namespace

Value exactPow(Value x, Value exponent) {
    const std::span<const float> found = x.editor->constantOf(exponent.id);
    if (found.empty()) return x.editor->isConstantExpression(exponent.id) ? powSpecialised(x, exponent) : Value{};
    const std::vector<float> exponents(found.begin(), found.end()); // new constants may move the table
    if (!std::ranges::all_of(exponents, isSmallWhole)) return {};
    if (std::ranges::all_of(exponents, [&](float each) { return each == exponents[0]; }))
        return wholePower(x, exponents[0]);
    std::vector<Value> parts;
    for (uint32_t i = 0; i < x.size(); ++i) parts.push_back(wholePower(x[i], exponents[i]));
    return compose(x.type(), parts);
}

// ---------------------------------------------------------------------------------------------- one variable

Value exactTan(Value x) { return call(GLSLstd450Sin, { x }) / call(GLSLstd450Cos, { x }); }

namespace {

/// Arc tangent on [0, 1], absolute error below 2e-8. Abramowitz and Stegun 1964, "Handbook of Mathematical
/// Functions", 4.4.49.
Value arcTangentOfUnit(Value x) {
    constexpr float kCoefficients[] = { 0.0028662257f, -0.0161657367f, 0.0429096138f, -0.0752896400f,
                                        0.1065626393f, -0.1420889944f, 0.1999355085f, -0.3333314528f };
    const Value square = x * x;
    Value sum = x.like(kCoefficients[0]);
    for (size_t i = 1; i < std::size(kCoefficients); ++i) sum = sum * square + x.like(kCoefficients[i]);
    return x + x * (square * sum);
}

} // namespace

// The drivers' own arc functions are polynomials that each front end marks and reorders in its own way.
Value exactAtan2(Value y, Value x) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const Value ax = call(GLSLstd450FAbs, { x }), ay = call(GLSLstd450FAbs, { y }), zero = x.like(0.0f);
    const Value larger = call(GLSLstd450FMax, { call(GLSLstd450FMax, { ax, ay }), x.like(1e-37f) }); // atan(0, 0) is 0
    const Value octant = arcTangentOfUnit(call(GLSLstd450FMin, { ax, ay }) / larger);
    const Value quadrant = selectLess(ax, ay, 0.5f * kPi - octant, octant);
    const Value half = selectLess(x, zero, kPi - quadrant, quadrant);
    return selectLess(y, zero, -half, half);
}

Value exactAtan(Value x) { return exactAtan2(x, x.like(1.0f)); }

namespace {

/// sqrt(1 - x^2); 0 outside [-1, 1], so that arc functions saturate there.
Value legOfUnitCircle(Value x) {
    const Value square = (1.0f - x) * (1.0f + x);
    return call(GLSLstd450Sqrt, { call(GLSLstd450FMax, { square, x.like(0.0f) }) });
}

} // namespace

Value exactAsin(Value x) { return exactAtan2(x, legOfUnitCircle(x)); }

Value exactAcos(Value x) { return exactAtan2(legOfUnitCircle(x), x); }

Value exactSinh(Value x) { return 0.5f * (call(GLSLstd450Exp, { x }) - call(GLSLstd450Exp, { -x })); }

Value exactCosh(Value x) { return 0.5f * (call(GLSLstd450Exp, { x }) + call(GLSLstd450Exp, { -x })); }

Value exactTanh(Value x) {
    // Beyond 10 the result rounds to 1; the clamp keeps exp from overflowing.
    const Value clamped = call(GLSLstd450FMin, { call(GLSLstd450FMax, { x, x.like(-10.0f) }), x.like(10.0f) });
    const Value grows = call(GLSLstd450Exp, { clamped }), falls = call(GLSLstd450Exp, { -clamped });
    return (grows - falls) / (grows + falls);
}

Value exactAsinh(Value x) {
    const Value magnitude = call(GLSLstd450FAbs, { x });
    const Value root = call(GLSLstd450Sqrt, { 1.0f + magnitude * magnitude });
    return call(GLSLstd450FSign, { x }) * call(GLSLstd450Log, { magnitude + root });
}

Value exactAcosh(Value x) { return call(GLSLstd450Log, { x + call(GLSLstd450Sqrt, { x * x - 1.0f }) }); }

Value exactAtanh(Value x) { return 0.5f * call(GLSLstd450Log, { (1.0f + x) / (1.0f - x) }); }

// ---------------------------------------------------------------------------------------------- matrices

Value exactMatrixTimesVector(Value m, Value v) {
    std::vector<Value> terms;
    for (uint32_t i = 0; i < m.size(); ++i) terms.push_back(m[i] * v[i]);
    return sum(terms);
}

Value exactVectorTimesMatrix(Value v, Value m, SpirvEditor::Id type) {
    std::vector<Value> components;
    for (uint32_t i = 0; i < m.size(); ++i) components.push_back(dot(v, m[i]));
    return compose(type, components);
}

Value exactMatrixTimesMatrix(Value a, Value b, SpirvEditor::Id type) {
    std::vector<Value> columns;
    for (uint32_t i = 0; i < b.size(); ++i) columns.push_back(exactMatrixTimesVector(a, b[i]));
    return compose(type, columns);
}

Value exactOuterProduct(Value column, Value row, SpirvEditor::Id type) {
    std::vector<Value> columns;
    for (uint32_t i = 0; i < row.size(); ++i) columns.push_back(column * row[i]);
    return compose(type, columns);
}

namespace {

using Grid = std::array<std::array<Value, 4>, 4>; // [column][row]

Grid elementsOf(Value m) {
    Grid grid;
    for (uint32_t c = 0; c < m.size(); ++c) {
        const Value column = m[c];
        for (uint32_t r = 0; r < column.size(); ++r) grid[c][r] = column[r];
    }
    return grid;
}

/// For rows r, s and columns c, d.
Value minor2(Grid const& m, uint32_t c, uint32_t d, uint32_t r, uint32_t s) {
    return m[c][r] * m[d][s] - m[d][r] * m[c][s];
}

/// Determinant of an n x n matrix without one column and one row, with the sign of the cofactor.
Value cofactor(Grid const& m, uint32_t n, uint32_t column, uint32_t row) {
    std::array<uint32_t, 3> c{}, r{};
    for (uint32_t i = 0, ci = 0, ri = 0; i < n; ++i) {
        if (i != column) c[ci++] = i;
        if (i != row) r[ri++] = i;
    }
    Value value = m[c[0]][r[0]]; // n == 2
    if (n == 3) value = minor2(m, c[0], c[1], r[0], r[1]);
    if (n == 4) { // along the first remaining column
        const Value a = m[c[0]][r[0]] * minor2(m, c[1], c[2], r[1], r[2]);
        const Value b = m[c[0]][r[1]] * minor2(m, c[1], c[2], r[0], r[2]);
        value = (a - b) + m[c[0]][r[2]] * minor2(m, c[1], c[2], r[0], r[1]);
    }
    return (column + row) % 2 == 0 ? value : -value;
}

/// Expansion along the first column (Laplace).
Value determinant(Grid const& m, uint32_t n) {
    std::vector<Value> terms;
    for (uint32_t row = 0; row < n; ++row) terms.push_back(m[0][row] * cofactor(m, n, 0, row));
    return sum(terms);
}

} // namespace

Value exactDeterminant(Value m) { return determinant(elementsOf(m), m.size()); }

Value exactInverse(Value m) {
    const uint32_t n = m.size();
    const Grid grid = elementsOf(m);
    const Value scale = 1.0f / determinant(grid, n);
    const SpirvEditor::Id columnType = m.editor->elementType(m.type());
    std::vector<Value> columns;
    for (uint32_t c = 0; c < n; ++c) { // the adjugate is the transpose of the cofactors
        std::vector<Value> rows;
        for (uint32_t r = 0; r < n; ++r) rows.push_back(cofactor(grid, n, r, c));
        columns.push_back(compose(columnType, rows) * scale);
    }
    return compose(m.type(), columns);
}

} // namespace filament_core::shader

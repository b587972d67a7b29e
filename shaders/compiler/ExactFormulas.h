// SPDX-License-Identifier: Apache-2.0
/// The formulas of ExactLowering: each GLSL operation as the sequence that both APIs execute.
///   Sources  GLSL 4.50 specification, chapter 8 (definitions); cited where the definition leaves the order open.
#pragma once

#include "shaders/compiler/SpirvMath.h"

namespace filament_core::shader {

// ---- geometry and blending
Value exactLength(Value v);                       ///< sqrt(dot(v, v)); |v| for scalars
Value exactNormalize(Value v);                    ///< v * inversesqrt(dot(v, v)), 0 for 0; sign(v) for scalars
Value exactReflect(Value incident, Value normal); ///< I - N * (2 * dot(N, I))
Value exactRefract(Value incident, Value normal, Value eta);
Value exactCross(Value a, Value b);
Value exactFaceForward(Value normal, Value incident, Value reference);
Value exactMix(Value a, Value b, Value t); ///< a + (b - a) * t
Value exactSmoothStep(Value edge0, Value edge1, Value x);
Value exactMod(Value x, Value y);    ///< x - y * floor(x / y)
Value exactDivide(Value x, Value y); ///< by a constant: x * (1 / y)
/// Products for whole constant exponents in [-8, 8], defined for negative x, too; nothing (keep pow) for others.
Value exactPow(Value x, Value exponent);

// ---- functions of one variable
Value exactTan(Value x); ///< sin(x) / cos(x)
Value exactAtan2(Value y, Value x);
Value exactAtan(Value x);
Value exactAsin(Value x);
Value exactAcos(Value x);
Value exactSinh(Value x);
Value exactCosh(Value x);
Value exactTanh(Value x);
Value exactAsinh(Value x);
Value exactAcosh(Value x);
Value exactAtanh(Value x);

// ---- matrices; columns first, as in GLSL
Value exactMatrixTimesVector(Value m, Value v);                       ///< ((m0 * x + m1 * y) + m2 * z) + m3 * w
Value exactVectorTimesMatrix(Value v, Value m, SpirvEditor::Id type); ///< component i: dot(v, column i)
Value exactMatrixTimesMatrix(Value a, Value b, SpirvEditor::Id type); ///< column i: a * (column i of b)
Value exactOuterProduct(Value column, Value row, SpirvEditor::Id type);
Value exactDeterminant(Value m);
Value exactInverse(Value m);

} // namespace filament_core::shader

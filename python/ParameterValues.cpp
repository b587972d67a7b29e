// SPDX-License-Identifier: Apache-2.0
#include "python/Bindings.h"

#include <limits>

namespace filament_core::python {
namespace {

constexpr double kMostFloat = std::numeric_limits<float>::max();

/// Whole numbers and booleans are finite numbers in a range; `least` > `most`: of floats.
template <class T>
T componentOf(double value, const char* name) {
    if constexpr (std::is_same_v<T, float>) {
        return static_cast<float>(numberIn(value, name, -kMostFloat, kMostFloat));
    } else if constexpr (std::is_same_v<T, bool>) {
        if (value != 0 && value != 1) raiseInvalid("{}: {} is not True or False", name, value);
        return value == 1;
    } else {
        const double whole = numberIn(value, name, std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
        if (whole != static_cast<double>(static_cast<T>(whole))) raiseInvalid("{}: {} is no whole number", name, value);
        return static_cast<T>(whole);
    }
}

template <class T>
ParameterValue scalarOf(py::handle value, const char* name) {
    return ParameterValue(componentOf<T>(numbersOf(py::make_tuple(value), name, 1)[0], name));
}

template <class Vector>
ParameterValue vectorOf(py::handle value, const char* name) {
    constexpr auto kCount = static_cast<size_t>(Vector::length());
    const std::vector<double> numbers = numbersOf(value, name, kCount);
    Vector vector{};
    for (size_t i = 0; i < kCount; ++i)
        vector[static_cast<int>(i)] = componentOf<typename Vector::value_type>(numbers[i], name);
    return ParameterValue(vector);
}

/// Row by row, as NumPy has matrices.
template <class Matrix>
ParameterValue matrixOf(py::handle value, const char* name) {
    constexpr auto kSide = static_cast<size_t>(Matrix::length());
    const bool isSequence = PySequence_Check(value.ptr()) && PySequence_Size(value.ptr()) == Py_ssize_t{ kSide };
    PyErr_Clear();
    if (!isSequence) raiseInvalid("{}: give a matrix of {} x {} numbers", name, kSide, kSide);
    Matrix matrix{};
    for (size_t row = 0; row < kSide; ++row) {
        const py::object numbers = py::reinterpret_borrow<py::sequence>(value)[row];
        const std::vector<double> one = numbersOf(numbers, name, kSide);
        for (size_t column = 0; column < kSide; ++column)
            matrix[static_cast<int>(column)][static_cast<int>(row)] = static_cast<float>(one[column]);
    }
    return ParameterValue(matrix);
}

using Convert = ParameterValue (*)(py::handle, const char*);

Convert conversionOf(ParameterType type) {
    static constexpr Convert kConversions[] = {
        scalarOf<bool>,   vectorOf<bool2>,    vectorOf<bool3>,    vectorOf<bool4>,   scalarOf<float>,
        vectorOf<float2>, vectorOf<float3>,   vectorOf<float4>,   scalarOf<int32_t>, vectorOf<int2>,
        vectorOf<int3>,   vectorOf<int4>,     scalarOf<uint32_t>, vectorOf<uint2>,   vectorOf<uint3>,
        vectorOf<uint4>,  matrixOf<float3x3>, matrixOf<float4x4>,
    };
    static_assert(std::size(kConversions) == static_cast<size_t>(ParameterType::Sampler2D));
    const auto index = static_cast<size_t>(type);
    return index < std::size(kConversions) ? kConversions[index] : nullptr;
}

} // namespace

ParameterValue parameterOf(ParameterDescription const& parameter, py::handle value) {
    const Convert convert = conversionOf(parameter.type);
    if (!convert) raiseInvalid("{}: is a {}; give it a Texture", parameter.name, toString(parameter.type));
    const std::string name = fmt::format("{} ({})", parameter.name, toString(parameter.type));
    return convert(value, name.c_str());
}

Sampler samplerOf(std::string const& filter, std::string const& wrap, int anisotropy) {
    Sampler sampler;
    if (filter == "nearest")
        sampler = { .magFilter = Filter::Nearest, .minFilter = Filter::Nearest, .mipFilter = MipFilter::None };
    else if (filter == "bilinear")
        sampler.mipFilter = MipFilter::Nearest;
    else if (filter != "trilinear")
        raiseInvalid("filter: '{}' is not nearest, bilinear or trilinear", filter);
    if (wrap == "mirror")
        sampler.wrapU = sampler.wrapV = WrapMode::MirroredRepeat;
    else if (wrap == "clamp")
        sampler.wrapU = sampler.wrapV = WrapMode::ClampToEdge;
    else if (wrap != "repeat")
        raiseInvalid("wrap: '{}' is not repeat, mirror or clamp", wrap);
    sampler.anisotropy = static_cast<uint8_t>(anisotropy);
    return sampler;
}

} // namespace filament_core::python

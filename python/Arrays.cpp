// SPDX-License-Identifier: Apache-2.0
#include "python/Arrays.h"

#include "base/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::python {
namespace {

constexpr uint32_t kMaxSide = 16384;
constexpr double kLastId = 1 << 24; // beyond it floats skip whole numbers

std::string textOf(py::handle value) {
    std::string text = py::repr(value).cast<std::string>();
    constexpr size_t kShown = 60;
    return text.size() <= kShown ? text : text.substr(0, kShown) + "...";
}

double numberOf(py::handle item, const char* name) {
    const double value = PyFloat_AsDouble(item.ptr());
    if (value == -1 && PyErr_Occurred()) {
        PyErr_Clear();
        raiseInvalid("{}: {} is no number", name, textOf(item));
    }
    return value;
}

/// A C-contiguous array of `T`; strings and objects are not converted.
template <class T>
py::array_t<T, py::array::c_style | py::array::forcecast> numericArray(py::handle values, const char* name) {
    const py::array given = py::array::ensure(values);
    if (!given || !std::strchr("biuf", given.dtype().kind())) {
        PyErr_Clear();
        raiseInvalid("{}: {} is no array of numbers", name, textOf(values));
    }
    return py::array_t<T, py::array::c_style | py::array::forcecast>(given);
}

template <class T>
std::vector<T> rgbaOf(py::array const& array, T opaque) {
    const py::array_t<T, py::array::c_style | py::array::forcecast> values(array);
    const size_t channels = static_cast<size_t>(values.shape(2));
    const size_t pixels = static_cast<size_t>(values.shape(0) * values.shape(1));
    std::vector<T> rgba(pixels * 4, opaque);
    for (size_t i = 0; i < pixels; ++i) std::copy_n(values.data() + i * channels, channels, rgba.data() + i * 4);
    return rgba;
}

} // namespace

double numberIn(double value, const char* name, double least, double most) {
    if (!(value >= least && value <= most)) raiseInvalid("{}: {} is not from {} to {}", name, value, least, most);
    return value;
}

float quantityOf(double value, const char* name) { return static_cast<float>(numberIn(value, name, 0, 1e12)); }

std::vector<double> numbersOf(py::handle values, const char* name, size_t count, double least) {
    // Of any length that it says: a generator may have no end.
    const bool isSequence = PySequence_Check(values.ptr()) && !py::isinstance<py::str>(values);
    if (!isSequence || PySequence_Size(values.ptr()) != static_cast<Py_ssize_t>(count)) {
        PyErr_Clear();
        raiseInvalid("{}: {} is not a sequence of {} numbers", name, textOf(values), count);
    }
    std::vector<double> numbers;
    for (size_t i = 0; i < count; ++i) {
        PyObject* got = PySequence_GetItem(values.ptr(), static_cast<Py_ssize_t>(i));
        if (!got) throw py::error_already_set();
        const auto item = py::reinterpret_steal<py::object>(got);
        const double value = numberOf(item, name);
        if (!(value >= least && value <= std::numeric_limits<float>::max()))
            raiseInvalid("{}: {} is not {}", name, value, least < 0 ? "a finite number" : "a finite number >= 0");
        numbers.push_back(value);
    }
    return numbers;
}

double3 double3Of(py::handle values, const char* name) {
    const std::vector<double> v = numbersOf(values, name, 3);
    return { v[0], v[1], v[2] };
}

float3 float3Of(py::handle values, const char* name) { return float3(double3Of(values, name)); }

float3 colorOf(py::handle values, const char* name) {
    const std::vector<double> v = numbersOf(values, name, 3, 0);
    return float3(double3(v[0], v[1], v[2]));
}

float3 directionOf(py::handle values, const char* name) {
    const double3 v = double3Of(values, name);
    const double length = std::hypot(v.x, v.y, v.z);
    if (!(length >= 1e-30)) raiseInvalid("{}: the direction is zero", name);
    return float3(v / length);
}

double4x4 transformOf(py::object const& matrix, const char* name) {
    if (matrix.is_none()) return double4x4(1.0);
    const auto values = numericArray<double>(matrix, name);
    if (values.ndim() != 2 || values.shape(0) != 4 || values.shape(1) != 4)
        raiseInvalid("{}: a transform is a 4 x 4 matrix", name);
    double4x4 result;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const double value = values.at(row, column);
            if (!(std::abs(value) <= 1e30)) raiseInvalid("{}: {} in the matrix is not finite", name, value);
            if (row == 3 && value != (column == 3 ? 1 : 0))
                raiseInvalid("{}: the last row of a transform is 0 0 0 1", name);
            result[column][row] = value;
        }
    }
    return result;
}

py::array_t<double> arrayOf(double4x4 const& matrix) {
    py::array_t<double> result({ 4, 4 });
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) result.mutable_at(row, column) = matrix[column][row];
    return result;
}

py::object arrayOf(Box const& box) {
    if (box.empty()) return py::none();
    py::array_t<double> result({ 2, 3 });
    for (int axis = 0; axis < 3; ++axis) {
        result.mutable_at(0, axis) = box.min[axis];
        result.mutable_at(1, axis) = box.max[axis];
    }
    return result;
}

std::vector<float> rowsOf(py::handle values, const char* name, size_t columns) {
    const auto rows = numericArray<double>(values, name);
    if (rows.ndim() != 2 || static_cast<size_t>(rows.shape(1)) != columns || rows.shape(0) >= (1 << 24))
        raiseInvalid("{}: not an array of fewer than 2^24 rows of {} numbers", name, columns);
    std::vector<float> result;
    for (const double value : std::span(rows.data(), static_cast<size_t>(rows.size()))) {
        if (!(std::abs(value) <= std::numeric_limits<float>::max()))
            raiseInvalid("{}: {} is not a finite float", name, value);
        result.push_back(static_cast<float>(value));
    }
    return result;
}

py::array arrayOf(Image const& image) {
    const std::array<py::ssize_t, 3> shape{ static_cast<py::ssize_t>(image.height),
                                            static_cast<py::ssize_t>(image.width), 4 };
    const size_t count = size_t{ image.width } * image.height * 4;
    if (image.format == Format::RGBA8) {
        py::array_t<uint8_t> result(shape);
        std::memcpy(result.mutable_data(), image.pixels.data(), std::min(count, image.pixels.size()));
        return result;
    }
    py::array_t<float> result(shape);
    float* out = result.mutable_data();
    if (image.format == Format::RGBA32F) {
        std::memcpy(out, image.pixels.data(), std::min(count * sizeof(float), image.pixels.size()));
        return result;
    }
    const std::byte* bytes = image.pixels.data();
    for (size_t i = 0; i < count; ++i) {
        uint16_t half = 0;
        std::memcpy(&half, bytes + i * sizeof half, sizeof half);
        out[i] = floatFromHalf(half);
    }
    return result;
}

IdArray idsOf(py::handle image, const char* name) {
    const auto values = numericArray<double>(image, name);
    const bool isFlat = values.ndim() == 2;
    if (!isFlat && (values.ndim() != 3 || values.shape(2) != 4))
        raiseInvalid("{}: an image of ids has the shape (height, width, 4) or (height, width)", name);
    if (values.shape(0) > kMaxSide || values.shape(1) > kMaxSide)
        raiseInvalid("{}: a side has more than {} pixels", name, kMaxSide);
    IdArray array{ .width = static_cast<uint32_t>(values.shape(1)), .height = static_cast<uint32_t>(values.shape(0)) };
    array.ids.resize(size_t{ array.width } * array.height);
    const size_t channels = isFlat ? 1 : 4;
    for (size_t i = 0; i < array.ids.size(); ++i) {
        const double value = values.data()[i * channels];
        if (!isFlat && values.data()[i * channels + 3] != 1) continue;
        if (!(value >= 0 && value <= kLastId) || value != std::floor(value))
            raiseInvalid("{}: {} is no id: those are whole numbers up to 2^24", name, value);
        array.ids[i] = static_cast<uint32_t>(value);
    }
    return array;
}

Image PictureArray::image() const {
    Image image{ .width = width, .height = height, .format = isFloat ? Format::RGBA16F : Format::RGBA8 };
    if (!isFloat) {
        const auto bytes = std::as_bytes(std::span(codes));
        image.pixels.assign(bytes.begin(), bytes.end());
        return image;
    }
    image.pixels.resize(light.size() * sizeof(uint16_t));
    for (size_t i = 0; i < light.size(); ++i) {
        const uint16_t half = halfFromFloat(light[i]);
        std::memcpy(image.pixels.data() + i * sizeof half, &half, sizeof half);
    }
    return image;
}

PictureArray pictureOf(py::handle array, const char* name) {
    const bool isArray = py::isinstance<py::array>(array);
    const auto given = isArray ? py::reinterpret_borrow<py::array>(array) : py::array();
    const bool isCodes = isArray && given.dtype().kind() == 'u' && given.dtype().itemsize() == 1;
    const bool isLight = isArray && given.dtype().kind() == 'f';
    if (!isCodes && !isLight) raiseInvalid("{}: a picture is an array of uint8 or of floats", name);
    if (given.ndim() != 3 || (given.shape(2) != 3 && given.shape(2) != 4) || given.size() == 0 ||
        given.shape(0) > kMaxSide || given.shape(1) > kMaxSide) {
        raiseInvalid("{}: a picture has the shape (height, width, 3 or 4), each side from 1 to {}", name, kMaxSide);
    }
    PictureArray picture{ .width = static_cast<uint32_t>(given.shape(1)),
                          .height = static_cast<uint32_t>(given.shape(0)),
                          .isFloat = isLight };
    if (isLight)
        picture.light = rgbaOf<float>(given, 1.0f);
    else
        picture.codes = rgbaOf<uint8_t>(given, uint8_t{ 255 });
    return picture;
}

} // namespace filament_core::python

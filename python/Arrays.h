// SPDX-License-Identifier: Apache-2.0
/// Arrays: numbers and images of Python as the engine's values, and the engine's as NumPy's.
///   Fails   InvalidArgumentError that names what was given, what is wrong and what is valid; only finite numbers come
///           through.
///   Thread  one that holds the interpreter's lock.
#pragma once

#include "python/Errors.h"

#include <filament_core/Box.h>
#include <filament_core/Image.h>
#include <filament_core/Math.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::python {

/// A finite number in [least, most].
double numberIn(double value, const char* name, double least, double most);
/// A length, a range, an intensity: finite, >= 0, and a float.
float quantityOf(double value, const char* name);

/// A sequence of `count` finite numbers that floats can hold, each >= `least`.
std::vector<double> numbersOf(py::handle values, const char* name, size_t count,
                              double least = -std::numeric_limits<float>::max());
double3 double3Of(py::handle values, const char* name);
float3 float3Of(py::handle values, const char* name);
/// float3Of(), of components >= 0.
float3 colorOf(py::handle values, const char* name);
/// float3Of(), not zero.
float3 directionOf(py::handle values, const char* name);

/// A 4 x 4 matrix for column vectors, its last row (0, 0, 0, 1): row by row, as NumPy has it. None: the identity.
double4x4 transformOf(py::object const& matrix, const char* name);
py::array_t<double> arrayOf(double4x4 const& matrix);
/// [[min], [max]], or None if the box is empty.
py::object arrayOf(Box const& box);

/// Rows of `columns` finite numbers.
std::vector<float> rowsOf(py::handle values, const char* name, size_t columns);

/// Whole numbers of an image, row by row; 0 where there is none.
struct IdArray {
    uint32_t width = 0, height = 0;
    std::vector<uint32_t> ids{};
};
/// Of an image of ids: (height, width, 4) as render_aovs() gives it, with 1 in the last channel where there is one, or
/// (height, width).
IdArray idsOf(py::handle image, const char* name);

/// uint8 of shape (height, width, 4) from RGBA8; float32 from RGBA16F, converted exactly, and RGBA32F.
py::array arrayOf(Image const& image);

/// An image of Python: uint8 codes or float light, (height, width, 3 or 4).
struct PictureArray {
    uint32_t width = 0, height = 0;
    bool isFloat = false;
    std::vector<uint8_t> codes{}; ///< RGBA
    std::vector<float> light{};   ///< RGBA; may be infinite or not a number

    /// RGBA8, or RGBA16F: rounded to half floats.
    Image image() const;
};
PictureArray pictureOf(py::handle array, const char* name);

} // namespace filament_core::python

// SPDX-License-Identifier: Apache-2.0
// Differences of two images: by imgdiff's counts, filament-accuracy's relative error and FLIP.
#include "python/Bindings.h"
#include "toolkit/pictures/Flip.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/pictures/Picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::python {
namespace {

struct Comparison {
    uint64_t pixels = 0, identicalPixels = 0;
    double maxDifference = 0, rms = 0, relativeRms = 0, relativeMax = 0, flipMean = 0, flipP99 = 0;
};

/// Of the components in their own unit.
template <class T>
void compareComponents(std::vector<T> const& a, std::vector<T> const& b, Comparison& result) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); i += 4) {
        result.identicalPixels += std::memcmp(&a[i], &b[i], 4 * sizeof(T)) == 0;
        for (size_t c = i; c < i + 4; ++c) {
            if (std::memcmp(&a[c], &b[c], sizeof(T)) == 0) continue;
            const double difference = std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c]));
            sum += difference * difference;
            result.maxDifference = std::isnan(difference) ? std::numeric_limits<double>::infinity()
                                                          : std::max(result.maxDifference, difference);
        }
    }
    result.rms = std::sqrt(sum / static_cast<double>(a.size()));
}

tools::Picture lightOf(PictureArray const& array) {
    if (!array.isFloat) return tools::pictureOf(array.image());
    tools::Picture picture{ .width = array.width, .height = array.height };
    for (size_t i = 0; i < array.light.size(); i += 4)
        picture.pixels.emplace_back(array.light[i], array.light[i + 1], array.light[i + 2]);
    return picture;
}

void requireComparable(PictureArray const& reference, PictureArray const& test) {
    if (reference.width != test.width || reference.height != test.height)
        raiseInvalid("the pictures differ in size: {} x {} and {} x {}", reference.width, reference.height, test.width,
                     test.height);
    if (reference.isFloat != test.isFloat)
        raiseInvalid("one picture is of display codes (uint8), the other of light (floats): render both alike");
}

Comparison comparePictures(py::object const& first, py::object const& second) {
    const PictureArray reference = pictureOf(first, "reference"), test = pictureOf(second, "test");
    requireComparable(reference, test);
    return released([&] {
        Comparison result{ .pixels = uint64_t{ reference.width } * reference.height };
        compareComponents(reference.light, test.light, result);
        if (!reference.isFloat) compareComponents(reference.codes, test.codes, result);
        const tools::ErrorFigures relative = tools::compare(lightOf(reference), lightOf(test));
        const tools::FlipError flip = tools::flip(reference.image(), test.image());
        result.relativeRms = relative.rms;
        result.relativeMax = relative.max;
        result.flipMean = flip.mean;
        result.flipP99 = flip.p99;
        return result;
    });
}

py::array_t<float> flipMap(py::object const& first, py::object const& second) {
    const PictureArray reference = pictureOf(first, "reference"), test = pictureOf(second, "test");
    requireComparable(reference, test);
    const tools::FlipError error = released([&] { return tools::flip(reference.image(), test.image()); });
    py::array_t<float> map({ static_cast<py::ssize_t>(reference.height), static_cast<py::ssize_t>(reference.width) });
    std::copy(error.pixels.begin(), error.pixels.end(), map.mutable_data());
    return map;
}

py::array differencePicture(py::object const& first, py::object const& second) {
    const PictureArray reference = pictureOf(first, "reference"), test = pictureOf(second, "test");
    requireComparable(reference, test);
    const Image a = reference.image(), b = test.image();
    static_cast<void>(valueOf(tools::compareImages(a, b)));
    return arrayOf(tools::differenceImage(a, b));
}

Image imageToSave(py::object const& picture) { return pictureOf(picture, "picture").image(); }

void saveFile(std::filesystem::path const& path, py::object const& picture) {
    const Image image = imageToSave(picture);
    if (image.format == Format::RGBA8)
        check(released([&] { return savePng(path, image); }));
    else
        check(released([&] { return saveExr(path, image); }));
}

py::array loadFile(std::filesystem::path const& path) {
    Image image = valueOf(released([&] { return loadImage(path); }));
    if (image.format == Format::RGBA8Srgb) image.format = Format::RGBA8;
    return arrayOf(image);
}

std::string textOf(Comparison const& c) {
    return fmt::format("{} of {} pixels identical, max difference {:.4g}, rms {:.4g}, relative rms {:.4g}, FLIP {:.4g}",
                       c.identicalPixels, c.pixels, c.maxDifference, c.rms, c.relativeRms, c.flipMean);
}

void bindComparison(py::module_& module) {
    py::class_<Comparison>(module, "Comparison", "How far two pictures differ. From compare().")
            .def_property_readonly(
                    "identical", [](Comparison const& self) { return self.identicalPixels == self.pixels; },
                    "Whether all bits agree.")
            .def_readonly("pixels", &Comparison::pixels, "How many pixels there are.")
            .def_readonly("identical_pixels", &Comparison::identicalPixels,
                          "How many of them have the same bits in all components.")
            .def_readonly("max_difference", &Comparison::maxDifference,
                          "The largest difference of a component: in codes of 0 to 255, or in light.")
            .def_readonly("rms", &Comparison::rms,
                          "Root mean square of the differences of all components, in that unit.")
            .def_readonly(
                    "relative_rms", &Comparison::relativeRms,
                    "Root mean square of the relative error of pixels in linear light, as filament-accuracy has it.")
            .def_readonly("relative_max", &Comparison::relativeMax, "The largest relative error of a pixel.")
            .def_readonly("flip_mean", &Comparison::flipMean, "Mean FLIP, from 0 (identical) to 1.")
            .def_readonly("flip_p99", &Comparison::flipP99, "The 99th percentile of FLIP.")
            .def("__repr__", [](Comparison const& self) { return "<Comparison: " + textOf(self) + ">"; });
}

} // namespace

void bindCompare(py::module_& module) {
    bindComparison(module);
    module.def(
            "compare", &comparePictures, py::arg("reference"), py::arg("test"),
            "Compares two pictures of one size: both uint8 codes, or both floats. Light is rounded to half floats for "
            "FLIP, and clamped to [0, 1].");
    module.def("flip", &flipMap, py::arg("reference"), py::arg("test"),
               "FLIP of each pixel (Andersson et al. 2020): an array (height, width) from 0 to 1.");
    module.def("difference", &differencePicture, py::arg("reference"), py::arg("test"),
               "imgdiff's picture of the differences: grey where bits agree, from yellow to red where they do not.");
    module.def("save_picture", &saveFile, py::arg("path"), py::arg("picture"),
               "Writes uint8 codes as a PNG, or light as an EXR of half floats.");
    module.def("load_picture", &loadFile, py::arg("path"),
               "Reads a PNG or JPEG of 8 bits as uint8 codes, any other picture as linear light in float32.");
}

} // namespace filament_core::python

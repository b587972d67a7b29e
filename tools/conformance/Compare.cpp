// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Compare.h"

#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/pictures/Flip.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/pictures/Picture.h"

namespace filament_core::conformance {
namespace {

bool isMesaCpu(DeviceDescription const& device) { return device.device.find("llvmpipe") != std::string::npos; }

bool agrees(Comparison const& c, Comparator const& comparator) {
    switch (comparator.kind) {
    case ComparatorKind::Bits:
        return c.differing == 0;
    case ComparatorKind::Tolerance:
        return c.maxDifference <= comparator.tolerance;
    case ComparatorKind::Flip:
        return c.flipMean <= comparator.flipMean && c.flipP99 <= comparator.flipP99;
    }
    return false;
}

Result<Image> readPicture(std::filesystem::path const& path) {
    Result<assets::Image> image = assets::readPng(path);
    if (!image) return image.error();
    return Image{ .width = image->width, .height = image->height, .pixels = std::move(image->data) };
}

std::string firstPixel(ImageComparison const& compared) {
    if (!compared.first) return {};
    PixelDifference const& first = *compared.first;
    return fmt::format("pixel ({}, {}) is {} and {}", first.x, first.y, textOf(first.a), textOf(first.b));
}

} // namespace

Comparator comparatorFor(Comparator const& asked, DeviceDescription const& a, DeviceDescription const& b) {
    const bool sameDevice = a.backend == b.backend && a.device == b.device && a.driver == b.driver;
    if (asked.kind != ComparatorKind::Bits || sameDevice || (isMesaCpu(a) && isMesaCpu(b))) return asked;
    Comparator flips = asked;
    flips.kind = ComparatorKind::Flip;
    return flips;
}

Result<Comparison> comparePictures(Image const& reference, Image const& test, Comparator const& comparator) {
    const Result<ImageComparison> compared = compareImages(reference, test);
    if (!compared) return compared.error();
    Comparison result{ .differing = compared->pixels - compared->identical, .maxDifference = compared->maxDifference };
    if (result.differing > 0 || comparator.kind == ComparatorKind::Flip) {
        const FlipError error = flip(reference, test);
        result.flipMean = error.mean, result.flipP99 = error.p99;
    }
    result.first = firstPixel(*compared);
    result.passed = agrees(result, comparator);
    return result;
}

Result<void> compareFiles(std::filesystem::path const& out, std::string const& reference,
                          std::filesystem::path const& drawn, Comparison& comparison) {
    const Result<Image> a = readPicture(out / reference), b = readPicture(drawn);
    if (!a) return a.error();
    if (!b) return b.error();
    const Result<ImageComparison> compared = compareImages(*a, *b);
    if (!compared) return compared.error();
    comparison.differing = std::max<uint64_t>(1, compared->pixels - compared->identical);
    comparison.maxDifference = compared->maxDifference;
    comparison.first = firstPixel(*compared);
    std::string stem = std::filesystem::path(reference).stem().string() + "." + comparison.configuration;
    std::ranges::replace(stem, ' ', '.');
    comparison.image = fmt::format("images/{}.png", stem);
    comparison.difference = fmt::format("images/{}.difference.png", stem);
    if (Result<void> saved = savePng(out / comparison.image, *b); !saved) return saved;
    return savePng(out / comparison.difference, differenceImage(*a, *b));
}

Image displayed(Image const& image) { return image.format == Format::RGBA8 ? image : displayImage(pictureOf(image)); }

} // namespace filament_core::conformance

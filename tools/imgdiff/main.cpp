// SPDX-License-Identifier: Apache-2.0
// imgdiff A.png B.png [--out DIFF.png] [--tolerance N]: the comparison of filament-render for any two pictures.
// Exit status 0: within the tolerance; 1: not; 2: the pictures could not be compared.
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/program/StandardOutput.h"

#include <cstdio>

namespace filament_core::tools {
namespace {

Result<Image> loadPng(std::string const& path) {
    Result<assets::Image> image = assets::readPng(path);
    if (!image) return image.error();
    return Image{ .width = image->width, .height = image->height, .pixels = std::move(image->data) };
}

int failed(Error const& error) {
    std::fprintf(stderr, "imgdiff: error: %s\n", error.message.c_str());
    return 2;
}

int finished(int status) {
    const Result<void> printed = finishOutput();
    return printed ? status : failed(printed.error());
}

int compareFiles(std::string const& pathA, std::string const& pathB, std::string const& out, uint32_t tolerance) {
    const Result<Image> a = loadPng(pathA), b = loadPng(pathB);
    if (!a) return failed(a.error());
    if (!b) return failed(b.error());
    const Result<ImageComparison> comparison = compareImages(*a, *b);
    if (!comparison) return failed(comparison.error());
    std::printf("%s\n", comparison->line().c_str());
    if (!out.empty()) {
        const Image picture = differenceImage(*a, *b);
        const Result<void> saved = assets::writePng(out, picture.width, picture.height, picture.pixels);
        if (!saved) return failed(saved.error());
    }
    return comparison->within(tolerance) ? 0 : 1;
}

} // namespace
} // namespace filament_core::tools

int main(int argc, char** argv) {
    filament_core::tools::CommandLine app{
        "Says how many pixels of two PNG files are the same and how far apart the others are.", "imgdiff"
    };
    std::string a, b, out;
    uint32_t tolerance = 0;
    app.option("A", a, "first picture").required();
    app.option("B", b, "second picture").required();
    app.option("--out", out, "write a picture of the differences");
    app.option("--tolerance", tolerance, "largest difference in 1/255 that still counts as equal");
    const filament_core::Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return filament_core::tools::failed(parsed.error());
    if (!*parsed) return filament_core::tools::finished(0);
    return filament_core::tools::finished(filament_core::tools::compareFiles(a, b, out, tolerance));
}

// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Shares.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/ShareSteps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

namespace filament_core {
namespace {

using engine::PublicCall;

constexpr std::array<std::string_view, 4> kShareChannels{ "R", "G", "B", "A" };

Result<Shares> sharesOf(Engine& engine, Scene const& scene, View const& view, ShareOptions const& options) {
    const std::vector<engine::ShareStep> steps = engine::shareSteps(scene, view, options);
    Shares shares{ .size = view.size };
    for (engine::ShareStep const& step : steps) shares.terms.push_back(step.term);
    const Result<void> drawn = engine::drawShares(engine, scene, steps, options.frames,
                                                  [&](Image&& image) { shares.sums.push_back(std::move(image)); });
    if (!drawn) return drawn.error();
    return shares;
}

constexpr size_t kMostLetters = 24; // of a layer of a file: 31 with the channel
constexpr std::string_view kRounding = "rounding";

/// The channels of OpenEXR files are named without points and spaces.
std::string layerNameOf(std::string_view term) {
    std::string name(term.substr(0, kMostLetters));
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    return name;
}

/// Terms whose names are equal so far end with _2, _3, ..., in their order.
std::vector<std::string> layerNamesOf(std::span<const ShareTerm> terms) {
    std::vector<std::string> names;
    const auto isTaken = [&](std::string_view name) {
        return name == kRounding || std::ranges::find(names, name) != names.end();
    };
    for (ShareTerm const& term : terms) {
        const std::string whole = layerNameOf(term.name);
        std::string name = whole;
        for (size_t nth = 2; isTaken(name); ++nth) {
            const std::string end = fmt::format("_{}", nth);
            name = whole.substr(0, kMostLetters - end.size()) + end;
        }
        names.push_back(std::move(name));
    }
    return names;
}

Image imageOfFloats(uint2 size) {
    return { .width = size.x,
             .height = size.y,
             .format = Format::RGBA32F,
             .pixels = std::vector<std::byte>(size_t{ size.x } * size.y * sizeof(float4)) };
}

void writePixel(Image& image, size_t pixel, float4 const& value) {
    std::memcpy(image.pixels.data() + pixel * sizeof(value), &value, sizeof(value));
}

/// What the rounded shares of a pixel lack together: exact in doubles, and in floats for up to 256 terms.
double4 lackOf(Shares const& shares, size_t pixel) {
    const uint2 at(static_cast<uint32_t>(pixel % shares.size.x), static_cast<uint32_t>(pixel / shares.size.x));
    double4 lack{ 0 };
    for (size_t term = 0; term < shares.terms.size(); ++term) {
        const double4 share = shares.share(term, at);
        lack += share - double4(float4(share));
    }
    return lack;
}

Result<void> saveLayersOf(std::filesystem::path const& path, Shares const& shares) {
    std::vector<Image> images;
    for (size_t term = 0; term < shares.terms.size(); ++term) images.push_back(shares.image(term));
    Image rounding = imageOfFloats(shares.size);
    bool isRounded = false;
    for (size_t pixel = 0; pixel < size_t{ shares.size.x } * shares.size.y; ++pixel) {
        const double4 lack = lackOf(shares, pixel);
        writePixel(rounding, pixel, float4(lack));
        isRounded = isRounded || lack != double4(0);
    }
    std::vector<ExrLayer> layers;
    const std::vector<std::string> names = layerNamesOf(shares.terms);
    for (size_t term = 0; term < images.size(); ++term)
        layers.push_back({ names[term], &images[term], kShareChannels });
    if (isRounded) layers.push_back({ std::string(kRounding), &rounding, kShareChannels });
    return saveExr(path, layers);
}

} // namespace

double4 Shares::share(size_t term, uint2 pixel) const {
    FILAMENT_ASSERT(term < terms.size() && pixel.x < size.x && pixel.y < size.y, "a share is of a term and a pixel");
    const size_t at = size_t{ pixel.y } * size.x + pixel.x;
    const std::array<uint16_t, 4> before = term > 0 ? engine::halvesAt(sums[term - 1], at) : std::array<uint16_t, 4>{};
    return engine::shareOf(before, engine::halvesAt(sums[term], at));
}

Image Shares::image(size_t term) const {
    Image image = imageOfFloats(size);
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x)
            writePixel(image, size_t{ y } * size.x + x, float4(share(term, { x, y })));
    }
    return image;
}

Result<Shares> renderShares(Engine& engine, Scene const& scene, View const& view, ShareOptions const& options) {
    const PublicCall call(engine, "renderShares(Engine, Scene, View)");
    return orOutOfMemory("render shares", {}, [&] { return sharesOf(engine, scene, view, options); });
}

Result<void> saveExr(std::filesystem::path const& path, Shares const& shares) {
    return orOutOfMemory("image", path.native(), [&] { return saveLayersOf(path, shares); });
}

} // namespace filament_core

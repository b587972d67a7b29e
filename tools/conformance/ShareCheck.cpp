// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/ShareCheck.h"

#include "base/Hash.h"
#include "base/math/Half.h"

#include <filament_core/ExplainPixel.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::conformance {
namespace {

/// Drawn as renderShares() does not: in one go.
Result<Image> drawnAtOnce(Engine& engine, Scene const& scene, View const& view, uint32_t frames) {
    const Owned<SwapChain> target = engine.own(engine.create(
            SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F, .name = "shares" }));
    Renderer renderer(engine);
    for (uint32_t frame = 0; frame < frames; ++frame) renderer.render(scene, view, target);
    return renderer.waitPixels(renderer.readPixels(target));
}

bool isFinite(double4 const& value) {
    return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z) && std::isfinite(value.w);
}

/// Both zeros are equal: a sum has no sign for nothing.
bool isPixel(Image const& picture, uint2 at, double4 const& sum) {
    std::array<uint16_t, 4> halves{};
    const size_t pixel = size_t{ at.y } * picture.width + at.x;
    std::memcpy(halves.data(), picture.pixels.data() + pixel * sizeof(halves), sizeof(halves));
    for (size_t i = 0; i < halves.size(); ++i)
        if (static_cast<double>(floatFromHalf(halves[i])) != sum[static_cast<int>(i)]) return false;
    return true;
}

void compareSums(Shares const& shares, Image const& picture, ShareVerdict& verdict) {
    for (uint32_t y = 0; y < shares.size.y; ++y) {
        for (uint32_t x = 0; x < shares.size.x; ++x) {
            double4 sum(0);
            for (size_t term = 0; term < shares.terms.size(); ++term) sum += shares.share(term, { x, y });
            ++verdict.tally.pixels;
            if (!isFinite(sum))
                ++verdict.tally.notFinite;
            else if (!isPixel(picture, { x, y }, sum) && verdict.tally.wrong++ == 0)
                verdict.faults.push_back(fmt::format("the shares of pixel {}, {} do not add up to it", x, y));
        }
    }
}

/// Of all values; `parts` names them.
template <class Parts>
void checkSum(Parts const& parts, const char* name, uint2 at, Image const& picture, ShareVerdict& verdict) {
    double4 sum(0);
    for (auto const& part : parts) sum += part.value;
    if (parts.empty() || !isFinite(sum) || isPixel(picture, at, sum)) return;
    verdict.faults.push_back(fmt::format("the {} of pixel {}, {} do not add up to it", name, at.x, at.y));
}

Result<void> explain(Engine& engine, Scene const& scene, View const& view, uint32_t frames, Image const& picture,
                     ShareVerdict& verdict) {
    const uint2 at = view.size / 2u;
    const Result<PixelExplanation> explained =
            explainPixel(engine, scene, view, at, { .terms = ShareTerms::All, .frames = frames });
    if (!explained) return explained.error();
    ++verdict.tally.explained;
    checkSum(explained->terms, "terms", at, picture, verdict);
    checkSum(explained->lobes, "lobes", at, picture, verdict);
    checkSum(explained->textures, "textures", at, picture, verdict);
    return {};
}

/// What renderShares() draws of it.
View wholeOf(View const& view) {
    View whole = view;
    whole.viewport.reset();
    whole.effects.resolution.dynamic = false;
    return whole;
}

} // namespace

std::string ShareTally::line() const {
    return fmt::format(
            "shares of {} pictures ({} left out): {} terms of light, {} of effects, {} pixels, {} of them not "
            "finite, {} with another sum; {} pixels explained; emission of {} pictures, {} pixels with light",
            pictures, leftOut, terms - effects, effects, pixels, notFinite, wrong, explained, unlit, lightInEmission);
}

ShareTally& ShareTally::operator+=(ShareTally const& more) {
    pictures += more.pictures, leftOut += more.leftOut, terms += more.terms, effects += more.effects;
    pixels += more.pixels, notFinite += more.notFinite, wrong += more.wrong, explained += more.explained;
    unlit += more.unlit, lightInEmission += more.lightInEmission;
    return *this;
}

Result<ShareVerdict> checkShares(Engine& engine, Scene const& scene, View const& view, uint32_t frames) {
    ShareVerdict verdict;
    if (view.debugView != DebugView::None) {
        verdict.tally.leftOut = 1;
        return verdict;
    }
    const View whole = wholeOf(view);
    const Result<Image> picture = drawnAtOnce(engine, scene, whole, frames);
    if (!picture) return picture.error();
    const Result<Shares> shares = renderShares(engine, scene, whole, { .terms = ShareTerms::All, .frames = frames });
    if (!shares) return shares.error();
    verdict.tally.pictures = 1;
    verdict.tally.terms = static_cast<uint32_t>(shares->terms.size());
    for (ShareTerm const& term : shares->terms) verdict.tally.effects += term.kind == ShareKind::Effect ? 1 : 0;
    for (Image const& sum : shares->sums) verdict.hash = verdict.hash * 31 + hashBytes(sum.pixels);
    compareSums(*shares, *picture, verdict);
    verdict.emission = shares->sums.front();
    if (Result<void> done = explain(engine, scene, whole, frames, *picture, verdict); !done) return done.error();
    return verdict;
}

Result<void> compareEmission(Engine& engine, Scene const& unlit, View const& view, uint32_t frames,
                             ShareVerdict& verdict) {
    const Result<Shares> shares =
            renderShares(engine, unlit, wholeOf(view), { .terms = ShareTerms::All, .frames = frames });
    if (!shares) return shares.error();
    const auto isLight = [](ShareTerm const& term) {
        return term.kind == ShareKind::Environment || term.kind == ShareKind::Lights;
    };
    if (std::ranges::any_of(shares->terms, isLight)) return {};
    verdict.tally.unlit = 1;
    Image const& expected = shares->sums.front();
    constexpr size_t kPixelBytes = 4 * sizeof(uint16_t);
    for (size_t at = 0; at < expected.pixels.size(); at += kPixelBytes)
        if (std::memcmp(&expected.pixels[at], &verdict.emission.pixels[at], kPixelBytes) != 0)
            ++verdict.tally.lightInEmission;
    if (verdict.tally.lightInEmission > 0)
        verdict.faults.push_back(fmt::format("{} pixels of the emission have light", verdict.tally.lightInEmission));
    return {};
}

} // namespace filament_core::conformance

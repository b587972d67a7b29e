// SPDX-License-Identifier: Apache-2.0
/// PartialFilm: a tile of an image in some of its passes, so that several machines can share one image; FilmMerger
/// puts the parts together. The merged image has the bits of render() (Film.h: Order).
///   Thread  one; renderPart() works on the job system.
///   Memory  48 bytes per pixel of the tile and node (Film.h); FilmMerger: of the image.
///   Fails   renderPart(): as render(), and InvalidArgument for a region outside the image, or whose file would
///           exceed kMaxPartBytes. The message says what to give instead.
#pragma once

#include "tools/reference/Film.h"

namespace filament_core::reference {

inline constexpr uint64_t kMaxPartBytes = 0xF0000000; ///< of pixels; files are read in one piece of at most 4 GiB

struct FilmRegion {
    uint2 offset{ 0, 0 }; ///< pixels; (0, 0) is the upper left corner of the image
    uint2 size{ 0, 0 };
    PassRange passes{};
    friend bool operator==(FilmRegion const&, FilmRegion const&) = default;
};
/// "pixels 0,0,64,64, passes 4 to 7"
std::string toString(FilmRegion const& region);
/// Both have this part of the image; an empty size or count: none.
FilmRegion intersection(FilmRegion const& a, FilmRegion const& b);

struct PartialFilm {
    FilmRegion region{};
    std::vector<FilmNode> nodes; ///< those of nodesOf(region.passes), pixels of the tile in rows
    uint64_t rays = 0, lostSamples = 0;
    double seconds = 0;
};

/// How the samples of a pixel are divided.
struct PassPlan {
    uint32_t samplesPerPass = 1, passes = 2;
};
PassPlan planOf(ReferenceSettings const& settings);

/// If `progress` stops it, `region.passes` of the result are those that are done. `settings.relativeError` must be 0:
/// only the whole image has an error.
Result<PartialFilm> renderPart(TracedScene const& scene, ReferenceView const& view, ReferenceSettings const& settings,
                               FilmRegion const& region, jobs::JobSystem& jobs, Progress const& progress = {});

class FilmMerger {
public:
    FilmMerger(uint2 size, PassPlan const& plan);
    /// Parts must be in the image, must not overlap, and must come in ascending order of `region.passes.first`.
    void add(PartialFilm const& part);
    /// After parts that cover the image. Seconds are the sum of all parts.
    ReferenceImage finish();

private:
    std::vector<PixelSums>& level(uint32_t exponent); ///< nodes of 2^exponent passes
    void addNode(FilmRegion const& region, FilmNode const& node);

    uint2 mSize;
    PassPlan mPlan;
    std::vector<std::vector<PixelSums>> mLevels;
    RenderStatistics mStatistics;
};

} // namespace filament_core::reference

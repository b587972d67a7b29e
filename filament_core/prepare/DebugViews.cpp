// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DebugViews.h"

#include <algorithm>
#include <array>

namespace filament_core::prepare {
namespace {

using Shows = DebugContent;

constexpr DebugViewRow lit(DebugView view, DebugContent content, Effect effect = Effect::Count) {
    return { .view = view, .content = content, .effect = effect, .isOfEffectPass = false };
}
constexpr DebugViewRow unlit(DebugView view, DebugContent content) {
    return { .view = view, .content = content, .isLit = false };
}

constexpr std::array kDebugViews{
    lit(DebugView::None, Shows::Image),
    lit(DebugView::Cascades, Shows::Shadows),
    lit(DebugView::Atlas, Shows::Shadows),
    lit(DebugView::Froxels, Shows::Lights),
    lit(DebugView::Lights, Shows::Lights),
    lit(DebugView::Occlusion, Shows::Effect, Effect::AmbientOcclusion),
    lit(DebugView::BentNormals, Shows::Effect, Effect::AmbientOcclusion),
    lit(DebugView::Reflections, Shows::Effect, Effect::Reflections),
    lit(DebugView::Refraction, Shows::Effect, Effect::Refraction),
    lit(DebugView::Fog, Shows::Effect, Effect::Fog),
    lit(DebugView::Motion, Shows::Effect, Effect::Motion),
    DebugViewRow{ DebugView::CircleOfConfusion, Shows::Effect, Effect::DepthOfField },
    DebugViewRow{ DebugView::HistoryWeight, Shows::Effect, Effect::Taa },
    DebugViewRow{ DebugView::Histogram, Shows::Effect, Effect::AutoExposure },
    DebugViewRow{ DebugView::Luminance, Shows::Numbers },
    DebugViewRow{ DebugView::Numerics, Shows::Numbers },
    unlit(DebugView::BaseColor, Shows::Material),
    unlit(DebugView::Roughness, Shows::Material),
    unlit(DebugView::Metallic, Shows::Material),
    unlit(DebugView::Normals, Shows::Material),
    unlit(DebugView::Tangents, Shows::Material),
    unlit(DebugView::TextureCoordinates, Shows::Material),
    unlit(DebugView::MaterialOcclusion, Shows::Material),
    unlit(DebugView::Emissive, Shows::Material),
    unlit(DebugView::MipLevel, Shows::Material),
    unlit(DebugView::Overdraw, Shows::Count),
    unlit(DebugView::TransparentLayers, Shows::Count),
    DebugViewRow{ DebugView::Wireframe, Shows::Edges },
    unlit(DebugView::WireframeAlone, Shows::Edges),
    unlit(DebugView::Plausibility, Shows::Material),
    lit(DebugView::Probes, Shows::Effect, Effect::ReflectionProbes),
    unlit(DebugView::GeometricNormals, Shows::Material),
    unlit(DebugView::Depth, Shows::Depth),
    unlit(DebugView::Positions, Shows::Depth),
    unlit(DebugView::ObjectIds, Shows::Objects),
    unlit(DebugView::MaterialIds, Shows::Objects),
    unlit(DebugView::MaterialInstanceIds, Shows::Objects),
    unlit(DebugView::TriangleIds, Shows::Triangles),
    unlit(DebugView::Coverage, Shows::Coverage),
};

static_assert(kDebugViews.size() == kDebugViewCount &&
                      std::ranges::all_of(kDebugViews,
                                          [](DebugViewRow const& row) {
                                              return &row - kDebugViews.data() == static_cast<std::ptrdiff_t>(row.view);
                                          }),
              "every debug view has a row, in the order of the enumerators");

/// By Aov.
constexpr std::array<DebugView, kAovCount> kViewsOfAovs{
    DebugView::None,
    DebugView::Depth,
    DebugView::Positions,
    DebugView::Normals,
    DebugView::GeometricNormals,
    DebugView::Tangents,
    DebugView::TextureCoordinates,
    DebugView::BaseColor,
    DebugView::Roughness,
    DebugView::Metallic,
    DebugView::MaterialOcclusion,
    DebugView::Emissive,
    DebugView::ObjectIds,
    DebugView::MaterialIds,
    DebugView::MaterialInstanceIds,
    DebugView::TriangleIds,
    DebugView::Motion,
    DebugView::Coverage,
};

} // namespace

DebugView debugViewOf(Aov aov) { return kViewsOfAovs[static_cast<size_t>(aov)]; }

DebugViewRow const& rowOf(DebugView view) { return kDebugViews[static_cast<size_t>(view)]; }

} // namespace filament_core::prepare

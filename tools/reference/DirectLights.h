// SPDX-License-Identifier: Apache-2.0
/// DirectLights: suns, points and spots: light from a single direction each, with the engine's attenuation formulas and
/// the candelas of photometric files; and rectangles, discs and tubes, of which each sample takes one point, every one
/// as likely.
///   Method  one light is chosen per point, in proportion to its illuminance there (luminance of lux, facing the light,
///           unoccluded; of an area that of its whole at its centre). A light that cannot contribute is never chosen,
///           and a single light is always chosen.
///   Size    of suns, points and spots: light arrives from the centre; only its shadow ray goes to a point of the disc
///           that the light shows there.
///   Units   lux at normal incidence times `factor`.
///   Memory  350 bytes per light. Thread: read-only after construction.
#pragma once

#include "base/math/Math.h"
#include "tools/reference/LightPictures.h"
#include "tools/reference/LightProfiles.h"

#include <filament_core/Light.h>

#include <limits>
#include <optional>
#include <vector>

namespace filament_core::reference {

/// What shines besides the environment and surfaces. Profiles and images are in lists of their own, parallel to the
/// lights; a missing or null one: none. Handles such as PointLight::profile mean nothing here.
struct LightSet {
    std::vector<SunLight> suns{}; ///< all of them shine
    std::vector<PointLight> points{};
    std::vector<SpotLight> spots{};
    std::vector<RectLight> rects{};
    std::vector<DiscLight> discs{};
    std::vector<TubeLight> tubes{};
    std::vector<ProfilePtr> pointProfiles{}, spotProfiles{};
    std::vector<LightPicturePtr> sunImages{}, pointImages{}, spotImages{}, rectImages{};
    double3 origin{ 0.0 }; ///< of all positions, in the world: images of suns begin at the world's own
};

struct DirectSample {
    double3 direction{ 0.0 };   ///< from the point to the light, unit
    double3 illuminance{ 0.0 }; ///< divided by the probability of the choice; zero: no light reaches the point
    double distance = std::numeric_limits<double>::infinity();
    double radius = 0; ///< of the light's disc, seen from a metre away
    bool castsShadows = true;

    /// Towards a point of the light; u in [0, 1)^2, uniform over its disc. Unit.
    double3 towardsPoint(double2 u) const;
};

/// Of an area that is drawn.
struct SeenArea {
    double distance = 0;      ///< from the ray's origin
    double3 luminance{ 0.0 }; ///< times factor
};

class DirectLights {
public:
    DirectLights() = default;
    DirectLights(LightSet const& lights, double factor);

    bool empty() const { return mLights.empty(); }
    /// The luminance, times factor, that a camera sees of suns that show their disc: docs/lights.md, "A sun in the
    /// sky".
    double3 discsIn(double3 direction) const;
    /// The nearest area with `isVisible` on a ray, of those within a range of distances, from a side that shines.
    std::optional<SeenArea> seenArea(double3 origin, double3 direction, double nearest, double farthest) const;
    /// u chooses the light, `onArea` the point of an area; in [0, 1).
    DirectSample sample(double3 position, double u, double2 onArea = double2(0.5)) const;

private:
    struct Light {
        bool isSun = false, isSpot = false;
        double3 position{ 0.0 };
        double3 axis{ 0.0 };            // direction in which the light travels, unit
        double3 intensity{ 0.0 };       // lux or candela, times factor
        double inverseSquaredRange = 0; // 1/m^2
        double spotScale = 0, spotOffset = 0;
        double radius = 0; // metres; of suns: for each metre of distance; of tubes
        bool castsShadows = true;
        enum class Shape : uint8_t { None, Rect, Disc, Tube } shape = Shape::None;
        bool isTwoSided = false, isVisible = false;
        double3 halfX{ 0.0 }, halfY{ 0.0 }; // half edges or radii; of a tube halfX is half its axis
        double area = 0;                    // m^2 of one side
        ProfilePtr profile{};               // its -Z is `axis`
        double3 profileX{ 0.0 };            // unit
        LightPicturePtr image{};            // right and down, in images a metre (of spots: a metre away):
        double3 imageRight{ 0.0 }, imageDown{ 0.0 };
        double2 imageOffset{ 0.0 };
        bool showsDisc = false; // suns
        double haloSize = 1, haloFalloff = 0;
    };
    /// A point of an area, and the direction in which it shines.
    struct Emitter {
        double3 position{ 0.0 }, normal{ 0.0 };
    };
    template <class AreaLight>
    static Light areaOf(AreaLight const& area, double factor);
    static Emitter emitterAt(Light const& light, double2 u);
    static DirectSample arrivingFromArea(Light const& light, double3 position, double2 u);
    static DirectSample arriving(Light const& light, double3 position, double2 onArea);
    static double weightOf(Light const& light, double3 position);
    static void setProfile(Light& light, std::vector<ProfilePtr> const& profiles, size_t index, float3 direction,
                           float3 up);
    static double shareOf(Light const& light, double3 away);
    /// Turned to the direction and the side; 1 image a metre.
    static void setImage(Light& light, std::vector<LightPicturePtr> const& images, size_t index, float3 direction,
                         float3 up);
    static double3 colorOf(Light const& light, double3 position);
    static double3 shownBy(Light const& light, double3 at);
    void add(RectLight const& rect, double factor);
    void add(DiscLight const& disc, double factor);
    void add(TubeLight const& tube, double factor);

    static double distanceTo(Light const& light, double3 origin, double3 direction);

    std::vector<Light> mLights;
    bool mHasVisible = false;
};

} // namespace filament_core::reference

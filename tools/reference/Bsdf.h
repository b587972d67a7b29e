// SPDX-License-Identifier: Apache-2.0
/// Bsdf: how a SurfaceSample scatters light: a stack of layers as one function, with its value, a sampler, and the
/// sampler's density. From the top: clear coat, sheen, then the base (standard or cloth), then transmission.
///   Value   f(view, light) * |cos|, in 1/sr. Each layer multiplies the layers below by its transmission; the header of
///           each layer says how.
///   Sampler chooses a layer in proportion to the layers' albedos, then uses that layer's sampler.
///   Edge    views below the shading normal's horizon, which normal maps cause, are lifted to nov = 1e-4. The engine
///           clamps nov alone, which is singular for a light directly behind the surface. A solid seen from inside has
///           its base and its transmission, but no layers.
///   Thread  a value. Memory: none.
#pragma once

#include "tools/reference/ClothLobes.h"
#include "tools/reference/CoatLayer.h"
#include "tools/reference/SheenLayer.h"
#include "tools/reference/StandardLobes.h"
#include "tools/reference/TransmissionLobe.h"

#include <variant>

namespace filament_core::reference {

struct BsdfSample {
    double3 direction{ 0.0 }; ///< world, unit
    double pdf = 0;           ///< per steradian; 0: no direction, the path ends
    bool isStraight = false;  ///< not a density: the direction straight through, chosen with this probability
};

class Bsdf {
public:
    /// `useOcclusion`: the occlusion map dims ambient light as in the engine. `isBall`: solids are looked through as in
    /// the engine (TransmissionLobe.h) instead of entered.
    Bsdf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion, bool isBall = false);

    /// f * |cos(light, normal)|; below the horizon the transmitted light. `light`: world, unit.
    double3 evaluate(double3 light, LightSource source) const;
    /// u and choice in (0, 1).
    BsdfSample sample(double2 u, double choice) const;
    /// Density of sample(), per steradian, without the straight transmission.
    double pdf(double3 light) const;
    /// The straight transmission, for a sample with isStraight.
    double3 straightShare() const;
    /// The factor of irradiance / pi around the normal with DiffuseLight::Harmonics; 0 with an integral.
    double3 harmonicAlbedo() const;

private:
    using Base = std::variant<StandardLobes, ClothLobes>;
    enum Part : uint8_t { kCoat, kSheen, kTransmission, kBehind, kBare, kBase, kParts };

    void chooseChances();
    double3 baseAt(double3 light, LightSource source) const; ///< with the sheen's share removed, without the coat's
    double3 coatedAt(double3 light, LightSource source) const;
    double3 behindAt(double3 light, LightSource source) const;
    std::optional<double3> sampleOf(Part part, double2 u, double choice) const;
    double pdfOf(Part part, double3 light) const;
    bool isRefractedByCoat() const { return mCoat && mCoat->isExact(); }

    double3 mNormal;
    Base mBase;                // below an exact coat: seen along the refracted view
    std::optional<Base> mBare; // for the part without an exact coat
    std::optional<CoatLayer> mCoat;
    std::optional<SheenLayer> mSheen;
    std::optional<TransmissionLobe> mTransmission;
    double3 mBehind{ 0.0 };    // albedo of the diffuse lobe on the other side
    double mChances[kParts]{}; // the sum is 1
};

} // namespace filament_core::reference

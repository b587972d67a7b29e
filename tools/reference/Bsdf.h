// SPDX-License-Identifier: Apache-2.0
/// Bsdf: how a SurfaceSample scatters light: a stack of layers as one function, its value, a sampler, and the sampler's
/// density. From above: clear coat, sheen, then the base (standard or cloth), then what passes through the surface.
///   Value   f(view, light) * |cos|, in 1/sr. Each layer multiplies what lies below it by what it lets through; what
///           each does is in the header of that layer.
///   Sampler one layer in proportion to the layers' albedos, then that layer's own.
///   Edge    views below the shading normal's horizon, which normal maps make, are lifted to nov = 1e-4: the engine
///           clamps nov alone, which for a light right behind the surface is a pole. A solid seen from inside has its
///           base and its way out, no layers.
///   Thread  a value. Memory: none.
#pragma once

#include "tools/reference/ClothLobes.h"
#include "tools/reference/CoatLayer.h"
#include "tools/reference/SheenLayer.h"
#include "tools/reference/StandardLobes.h"
#include "tools/reference/TransmissionLobe.h"

#include <variant>

namespace filament::reference {

struct BsdfSample {
    double3 direction{ 0.0 }; ///< world, unit
    double pdf = 0;           ///< per steradian; 0: no direction, the path ends
    bool isStraight = false;  ///< not a density: the one direction that goes through, chosen by this probability
};

class Bsdf {
public:
    /// `useOcclusion`: the occlusion map dims ambient light as it does in the engine. `isBall`: solids are seen through
    /// as the engine does (TransmissionLobe.h), instead of entered.
    Bsdf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion, bool isBall = false);

    /// f * |cos(light, normal)|, below the horizon what is transmitted. `light`: world, unit.
    double3 evaluate(double3 light, LightSource source) const;
    /// u and choice in (0, 1).
    BsdfSample sample(double2 u, double choice) const;
    /// Of sample(), per steradian, without what goes straight through.
    double pdf(double3 light) const;
    /// What goes straight through, for a sample that does.
    double3 straightShare() const;
    /// What DiffuseLight::Harmonics multiplies irradiance / pi around the normal by; 0 with an integral.
    double3 harmonicAlbedo() const;

private:
    using Base = std::variant<StandardLobes, ClothLobes>;
    enum Part : uint8_t { kCoat, kSheen, kTransmission, kBehind, kBare, kBase, kParts };

    void chooseChances();
    double3 baseAt(double3 light, LightSource source) const; ///< with the sheen's share taken off, without the coat's
    double3 coatedAt(double3 light, LightSource source) const;
    double3 behindAt(double3 light, LightSource source) const;
    std::optional<double3> sampleOf(Part part, double2 u, double choice) const;
    double pdfOf(Part part, double3 light) const;
    bool isRefractedByCoat() const { return mCoat && mCoat->isExact(); }

    double3 mNormal;
    Base mBase;                // below an exact coat: seen along the refracted view
    std::optional<Base> mBare; // where an exact coat is not
    std::optional<CoatLayer> mCoat;
    std::optional<SheenLayer> mSheen;
    std::optional<TransmissionLobe> mTransmission;
    double3 mBehind{ 0.0 };    // albedo of the diffuse lobe on the other side
    double mChances[kParts]{}; // add up to 1
};

} // namespace filament::reference

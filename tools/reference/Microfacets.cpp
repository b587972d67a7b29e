// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Microfacets.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Mixture.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
Frame::Frame(double3 n) : normal(n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    tangent = { 1 + sign * n.x * n.x * a, sign * b, -sign * n.x };
    bitangent = { b, sign + n.y * n.y * a, -n.y };
}

Frame::Frame(double3 n, double3 along) : Frame(n) {
    const double3 flat = along - n * glm::dot(n, along);
    const double length = glm::length(flat);
    if (!(length > 1e-9)) return;
    tangent = flat / length;
    bitangent = glm::cross(normal, tangent);
}

double3 liftedAboveHorizon(double3 view) {
    if (view.z >= kMinNov) return view;
    const double size = std::hypot(view.x, view.y), radius = std::sqrt(1 - kMinNov * kMinNov);
    return size > 0 ? double3(view.x / size * radius, view.y / size * radius, kMinNov) : double3(radius, 0, kMinNov);
}

// Heitz 2018, listing 1: the hemisphere is squeezed until the lobe is a disc seen from the side.
double3 sampleVisibleNormal(double3 view, double2 alpha, double2 u) {
    const double3 stretched = glm::normalize(double3(alpha.x * view.x, alpha.y * view.y, view.z));
    Frame disc(stretched);
    // The disc's second axis lies in the plane of the normal, where the horizon cuts it.
    const double size = std::hypot(stretched.x, stretched.y);
    if (size > 0) {
        disc.tangent = double3(-stretched.y, stretched.x, 0) / size;
        disc.bitangent = glm::cross(stretched, disc.tangent);
    }
    const double radius = std::sqrt(u.x), azimuth = lib::kTwoPi * u.y;
    const double x = radius * std::cos(azimuth), s = 0.5 * (1 + stretched.z);
    const double y = (1 - s) * std::sqrt(1 - x * x) + s * radius * std::sin(azimuth);
    const double3 visible = disc.toWorld({ x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y)) });
    return glm::normalize(double3(alpha.x * visible.x, alpha.y * visible.y, std::max(visible.z, 1e-12)));
}

// Walter et al. 2007, eq. 34, with the roughness along the direction: Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs", eq. 86.
double smithMasking(double3 direction, double2 alpha) {
    const double cosine = std::abs(direction.z);
    return 2 * cosine / (cosine + std::hypot(alpha.x * direction.x, alpha.y * direction.y, direction.z));
}

double ggx(double3 halfway, double2 alpha) {
    return alpha.x == alpha.y ? lib::ndfGgxFromVectors({ 0, 0, 1 }, halfway, alpha.x)
                              : lib::ndfGgxAnisotropic(halfway, alpha);
}

double visibleReflectionPdf(double3 view, double3 light, double2 alpha) {
    const double3 sum = view + light;
    const double length = glm::length(sum);
    if (length < 1e-12) return 0;
    const double3 halfway = sum / length;
    if (halfway.z <= 0) return 0;
    // Visible half vectors have the density G1 D (v.h) / n.v; that of light directions is 4 v.h times smaller.
    return smithMasking(view, alpha) * ggx(halfway, alpha) / (4 * view.z);
}

double3 Interface::single(double cosine) const {
    double outside = cosine;
    if (mBelow.isFromInside) {
        const double sine2 = mBelow.ior * mBelow.ior * (1 - cosine * cosine);
        if (sine2 >= 1) return double3(1.0);
        outside = std::sqrt(1 - sine2);
    }
    const double3 f0 = mFilm.strength > 0 ? mFilm.bareF0 : mF0;
    const double3 bare = mTerm == FresnelTerm::Schlick
                                 ? lib::fresnelSchlick(f0, mF90, outside)
                                 : lib::fresnelExact(f0, mMetallic, outside) * mF90; // as in surface/quality.glsl
    return mFilm.strength > 0 ? glm::mix(bare, filmReflectance(mFilm, outside), mFilm.strength) : bare;
}

double3 Interface::throughSheet(double cosine) const {
    const double path = lib::thinPathLength(cosine, mBelow.ior, mBelow.thickness);
    return mBelow.color * lib::transmittance(mBelow.absorption, path);
}

// Stokes 1862, "On the Intensity of the Light Reflected from or Transmitted through a Pile of Plates": a sheet whose
// sides reflect F, and which transmits t of the light inside per crossing, reflects F + (1 - F)^2 F t^2 / (1 - F^2
// t^2).
double3 Interface::reflectance(double cosine) const {
    const double3 f = single(cosine);
    if (!mBelow.isThin || mBelow.color == double3(0.0)) return f;
    const double3 t = throughSheet(cosine), ft = f * t;
    return f + (1.0 - f) * (1.0 - f) * ft * t / glm::max(1.0 - ft * ft, 1e-12);
}

double3 Interface::transmittance(double cosine) const {
    const double3 f = single(cosine);
    if (!mBelow.isThin) return (1.0 - f) * mBelow.color;
    const double3 t = throughSheet(cosine), ft = f * t;
    return (1.0 - f) * (1.0 - f) * t / glm::max(1.0 - ft * ft, 1e-12);
}

} // namespace filament_core::reference

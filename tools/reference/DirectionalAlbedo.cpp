// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/DirectionalAlbedo.h"

#include "base/math/GaussLegendre.h"
#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/AlbedoTable.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

using std::numbers::pi;
constexpr int kCosines = 96, kRoughnesses = 64, kQuadrature = 16;
constexpr int kCoatCosines = 48, kCoatRoughnesses = 32;

// Smith's masking of one direction.
double masking(double cosine, double alpha) {
    const double a2 = alpha * alpha;
    return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine));
}

struct Reflection {
    double voh = 0, nol = 0;
};

/// Heitz' disc: every point is a half vector, and all are equally likely to be seen from v. Points are given by an
/// azimuth and an angle whose sine is the radius, so that nothing is singular at the disc's edge.
class VisibleNormals {
public:
    VisibleNormals(double nov, double alpha)
            : mAlpha(alpha), mView(std::sqrt(1 - nov * nov), 0, nov),
              mStretched(glm::normalize(double3(alpha * mView.x, 0, mView.z))), mSqueeze(0.5 * (1 + mStretched.z)) {}

    Reflection reflection(double angle, double azimuth) const {
        const double radius = std::sin(angle);
        const double across = radius * std::cos(azimuth), rest = std::sqrt(1 - across * across);
        const double along = (1 - mSqueeze) * rest + mSqueeze * radius * std::sin(azimuth);
        const double up = std::sqrt(std::max(0.0, rest * rest - along * along));
        const double3 towardsNormal(-mStretched.z, 0, mStretched.x);
        const double3 visible = along * towardsNormal + double3(0, across, 0) + up * mStretched;
        const double3 h = glm::normalize(double3(mAlpha * visible.x, mAlpha * visible.y, std::max(visible.z, 0.0)));
        const double voh = glm::dot(mView, h);
        return { voh, 2 * voh * h.z - mView.z };
    }

    /// The angle at which light comes from the horizon, or that of the disc's edge: the integrand has a kink there.
    double horizon(double azimuth) const {
        double inside = 0, outside = pi / 2;
        double above = reflection(inside, azimuth).nol, below = reflection(outside, azimuth).nol;
        if (below > 0) return outside;
        // Dowell and Jarratt 1971, "A Modified Regula Falsi Method for Computing the Root of an Equation".
        for (int step = 0; step < 8; ++step) { // Illinois method: secant, halving the retained end
            const double middle = inside + (outside - inside) * above / (above - below);
            const double nol = reflection(middle, azimuth).nol;
            if (nol > 0) {
                inside = middle, above = nol, below /= 2;
            } else {
                outside = middle, below = nol, above /= 2;
            }
        }
        return inside;
    }

private:
    double mAlpha;
    double3 mView, mStretched;
    double mSqueeze; // of the half of the disc that the view foreshortens
};

/// Integral over lights of D V F nol, F = weight(voh).
template <class Weight>
auto integrate(double nov, double alpha, std::vector<QuadratureNode> const& nodes, int azimuths, Weight const& weight) {
    const VisibleNormals normals(nov, alpha);
    const double maskingOfView = masking(nov, alpha);
    decltype(weight(0.0)) sum(0.0);
    for (int j = 0; j < azimuths; ++j) {
        const double azimuth = ((j + 0.5) / azimuths - 0.5) * pi; // the other half is its mirror image
        const double last = normals.horizon(azimuth);
        for (QuadratureNode const& node : nodes) {
            const double angle = node.x * last;
            const Reflection reflection = normals.reflection(angle, azimuth);
            if (reflection.nol <= 0 || reflection.voh <= 0) continue;
            const double measure = std::sin(2 * angle) * last * node.weight / azimuths;
            const double visibility = lib::visibilitySmithGgxCorrelated(nov, reflection.nol, alpha);
            const double passed = visibility * 4 * reflection.nol * nov / maskingOfView;
            sum += weight(std::min(reflection.voh, 1.0)) * (passed * measure);
        }
    }
    return sum;
}

double2 schlickAndWhite(double voh) { return { lib::pow5(1 - voh), 1.0 }; }

AlbedoTable<double2> const& schlickTable() {
    static const AlbedoTable<double2> sTable(kCosines, kRoughnesses, [](double nov, double roughness) {
        static const std::vector<QuadratureNode> sNodes = gaussLegendre(kQuadrature);
        return integrate(nov, lib::alphaFromPerceptual(roughness), sNodes, kQuadrature, schlickAndWhite);
    });
    return sTable;
}

AlbedoTable<double> const& coatTable() {
    static const AlbedoTable<double> sTable(kCoatCosines, kCoatRoughnesses, [](double nov, double roughness) {
        static const std::vector<QuadratureNode> sNodes = gaussLegendre(kQuadrature);
        return integrate(nov, lib::alphaFromPerceptual(roughness), sNodes, kQuadrature,
                         [](double voh) { return lib::fresnelComplex(voh, lib::kCoatIor, 0.0); });
    });
    return sTable;
}

} // namespace

double2 integrateDirectionalAlbedo(double nov, double alpha, int radii, int azimuths) {
    return integrate(nov, alpha, gaussLegendre(radii), azimuths, schlickAndWhite);
}

double2 directionalAlbedo(double nov, double perceptualRoughness) {
    return glm::clamp(schlickTable().lookUp(nov, perceptualRoughness), 1e-9, 1.0);
}

double2 averageDirectionalAlbedo(double perceptualRoughness) {
    constexpr int kEntries = 256; // linear interpolation between them: 1e-5
    static const std::vector<double2> sTable = [] {
        std::vector<double2> table;
        for (int i = 0; i <= kEntries; ++i)
            table.push_back(schlickTable().average(std::max(static_cast<double>(i) / kEntries, 0.045)));
        return table;
    }();
    const double at = std::clamp(perceptualRoughness, 0.0, 1.0) * kEntries;
    const auto entry = std::min(static_cast<size_t>(at), sTable.size() - 2);
    return glm::mix(sTable[entry], sTable[entry + 1], at - static_cast<double>(entry));
}

double coatAlbedo(double nov, double perceptualRoughness) {
    return std::clamp(coatTable().lookUp(nov, perceptualRoughness), 0.0, 1.0);
}

double averageCoatAlbedo(double perceptualRoughness) { return coatTable().average(perceptualRoughness); }

} // namespace filament_core::reference

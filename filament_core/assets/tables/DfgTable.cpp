// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/DfgTable.h"

#include "base/Assert.h"
#include "base/math/Elementary.h"
#include "base/math/GaussLegendre.h"
#include "base/math/Half.h"
#include "shaders/lib/LibCpp.h"

#include <cstring>
#include <span>
#include <vector>

namespace filament_core::assets {

namespace lib = shader::lib;

namespace {

struct Node {
    float x = 0, weight = 0;
};

// Substitutions on [0, 1] that are slow where an integrand behaves like a root or nearly has a pole. Nodes are weighted
// by the speed.
struct Step {
    double x = 0, speed = 1;
};

Step steady(double t) { return { t, 1 }; }
Step slowAtZero(double t) { return { t * t, 2 * t }; }
Step slowAtBothEnds(double t) { return { t * t * (3 - 2 * t), 6 * t * (1 - t) }; }

std::vector<Node> nodesAlong(int count, Step way(double)) {
    std::vector<Node> nodes;
    for (QuadratureNode const& node : gaussLegendre(count)) {
        const auto [x, speed] = way(node.x);
        nodes.push_back({ static_cast<float>(x), static_cast<float>(node.weight * speed) });
    }
    return nodes;
}

// Cosines of angles in [0, pi].
std::vector<Node> azimuths(int count) {
    std::vector<Node> nodes = nodesAlong(count, steady);
    for (Node& node : nodes) node.x = elementary::cos(lib::kPi * node.x);
    return nodes;
}

/// The half vectors that are visible from v and reflect light from above the surface, weighted by their visibility.
/// Heitz 2018, "Sampling the GGX Distribution of Visible Normals": if facets are squeezed by alpha along the surface,
/// they form a hemisphere, and v' = normalize(alpha v.x, alpha v.y, v.z) sees each of them by its cosine; together that
/// is pi (1 + v'.z) / 2. Write its directions as h' = (cos b sin a, sin b, cos b cos a): a is the rotation about the
/// axis perpendicular to the plane of incidence, b the angle with this plane, and the cosine times the solid angle is
/// cos(b)^2 cos(a - angle of v') da db. In this form the horizon n.l = 2 (v.h) (n.h) - n.v = 0 has a closed form in
/// both angles, so nothing is searched for.
class VisibleHalfVectors {
public:
    VisibleHalfVectors(float nov, float alpha)
            : mNov(nov), mSine(std::sqrt((1 - nov) * (1 + nov))), mAlpha(alpha),
              mFirst(elementary::atan(-nov / ((1 + mSine) * alpha))),
              mSpan(elementary::atan((1 + mSine) / (nov * alpha)) - mFirst) {
        const float length = std::sqrt(alpha * alpha * mSine * mSine + nov * nov);
        mStretched = float2(alpha * mSine, nov) / length;
    }

    /// Calls visit(voh, nol, weight) for each; the weights sum to those of a mean.
    template <class Visit>
    void forEach(Visit const& visit) const {
        static const std::vector<Node> sTurns = nodesAlong(16, slowAtBothEnds);
        for (Node const& node : sTurns) {
            const float angle = mFirst + node.x * mSpan;
            visitSlice(elementary::sin(angle), elementary::cos(angle), node.weight, visit);
        }
    }

private:
    template <class Visit>
    void visitSlice(float sine, float cosine, float weight, Visit const& visit) const {
        static const std::vector<Node> sLeaves = nodesAlong(8, steady);
        const float length = std::sqrt(mAlpha * mAlpha * sine * sine + cosine * cosine);
        const float2 inPlane = float2(mAlpha * sine, cosine) / length;
        const float voh = mSine * inPlane.x + mNov * inPlane.y;
        const float excess = 2 * voh * inPlane.y - mNov; // n.l of the half vector in the plane
        if (excess <= 0) return;
        // tan(b) at the horizon, and tan(b / 2), of which sine and cosine are quotients
        const float horizon = std::sqrt(excess / mNov) * length / mAlpha;
        const float last = horizon / (1 + std::sqrt(1 + horizon * horizon));
        const float measure = weight * mSpan * (cosine * mStretched.y + sine * mStretched.x) * last *
                              (8 / (lib::kPi * (1 + mStretched.y)));
        for (Node const& node : sLeaves) {
            const float tangent = node.x * last, square = tangent * tangent, inverse = 1 / (1 + square);
            const float cosB = (1 - square) * inverse, sinB = 2 * tangent * inverse;
            const float toPlane =
                    cosB * length / std::sqrt(cosB * cosB * length * length + mAlpha * mAlpha * sinB * sinB);
            const float nol = 2 * voh * inPlane.y * toPlane * toPlane - mNov;
            if (nol > 0) visit(voh * toPlane, nol, measure * node.weight * cosB * cosB * inverse);
        }
    }

    float mNov, mSine, mAlpha;
    float mFirst, mSpan; // range of a: h is within 45 degrees of half the angle between v and the normal
    float2 mStretched{}; // sine and cosine of v'
};

/// A lobe of fibres, ndf(noh) times Neubelt's V n.l, integrated over all light directions, because it is as wide as the
/// hemisphere. By symmetry, half of the circle suffices.
template <class Ndf>
float fibreAlbedo(float nov, Ndf const& ndf) {
    static const std::vector<Node> sHeights = nodesAlong(16, slowAtZero), sAzimuths = azimuths(12);
    const float sine = std::sqrt((1 - nov) * (1 + nov));
    float sum = 0;
    for (Node const& height : sHeights) {
        const float nol = height.x, across = sine * std::sqrt((1 - nol) * (1 + nol));
        float ofRing = 0;
        for (Node const& azimuth : sAzimuths) {
            const float noh = (nov + nol) / std::sqrt(2 + 2 * (nov * nol + across * azimuth.x)); // |v + l|
            ofRing += azimuth.weight * ndf(std::min(noh, 1.0f));
        }
        sum += height.weight * nol * lib::visibilityNeubelt(nov, nol) * ofRing;
    }
    return sum * lib::kTwoPi;
}

} // namespace

// Heitz' estimator: the fraction V 4 nol nov / G1 of the facets visible from v is lit.
float2 integrateDfg(float nov, float alpha) {
    const float a2 = alpha * alpha;
    const float masking = 2 * nov / (nov + std::sqrt(a2 + (1 - a2) * nov * nov));
    float2 sum(0.0f);
    VisibleHalfVectors(nov, alpha).forEach([&](float voh, float nol, float weight) {
        const float lit = weight * lib::visibilitySmithGgxCorrelated(nov, nol, alpha) * nol;
        sum += float2(lit * lib::pow5(1 - std::min(voh, 1.0f)), lit);
    });
    return sum * (4 * nov / masking);
}

float integrateSheen(float nov, float alpha) {
    return fibreAlbedo(nov, [alpha](float noh) { return lib::ndfCharlie(noh, alpha); });
}

float integrateVelvet(float nov, float alpha) {
    return fibreAlbedo(nov, [alpha](float noh) { return lib::ndfAshikhmin(noh, alpha); });
}

Image bakeDfgTable(jobs::JobSystem& jobs, uint32_t size) {
    FILAMENT_ASSERT(size > 0, "a DFG table has at least one entry");
    Image table{ .width = size, .height = size, .format = backend::Format::RGBA16F, .data = {} };
    table.data.resize(table.levelBytes(0));
    jobs::parallelFor<"dfg table">(jobs, size, 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            const float roughness = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
            const float alpha = lib::alphaFromPerceptual(lib::clampPerceptualRoughness(roughness));
            for (size_t x = 0; x < size; ++x) {
                const float nov = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
                const float2 dfg = integrateDfg(nov, alpha);
                const uint16_t halves[4] = { halfFromFloat(dfg.x), halfFromFloat(dfg.y),
                                             halfFromFloat(integrateSheen(nov, alpha)),
                                             halfFromFloat(integrateVelvet(nov, alpha)) };
                std::memcpy(table.data.data() + (y * size + x) * sizeof(halves), halves, sizeof(halves));
            }
        }
    });
    return table;
}

} // namespace filament_core::assets

// SPDX-License-Identifier: Apache-2.0
#include "tools/ltcfit/LtcFit.h"

#include "base/Assert.h"
#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::tools {
namespace {

namespace lib = shader::lib64;

constexpr int kFitSteps = 32, kVariationSteps = 128;
constexpr int kNormSteps = 1024, kNormTurns = 32; // the tail of the lobe is in the last of many steps
constexpr int kMaxMoves = 400, kRestarts = 3;
constexpr double kConverged = 1e-10;
constexpr double kNearestToGrazing = 0.002;

double lobeOf(LtcTerms const& terms, double3 direction) {
    return lib::ltcLobe({ terms.a, terms.b, terms.d }, direction);
}

// A cosine-distributed direction, transformed back.
double3 sampleLtc(LtcTerms const& terms, double u, double v) {
    const double radius = std::sqrt(u), angle = lib::kPi * v;
    const double x = radius * std::cos(angle), z = std::sqrt(1 - u) / terms.d;
    return glm::normalize(double3((x - terms.b * z) / terms.a, radius * std::sin(angle), z));
}

/// The mean of error(f, g) over directions of the lobe, plus that over directions of the transformed cosine.
template <class Error>
double compare(GgxLobe const& lobe, LtcTerms const& terms, int steps, Error const& error) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double u = (i + 0.5) / steps, v = (j + 0.5) / steps;
            const double3 ofLobe = lobe.sample(u, v), ofLtc = sampleLtc(terms, u, v);
            if (ofLobe.z > 0)
                sum += lobe.weight(ofLobe) / lobe.norm() *
                       error(lobe.value(ofLobe) / lobe.norm(), lobeOf(terms, ofLobe));
            sum += error(lobe.value(ofLtc) / lobe.norm(), lobeOf(terms, ofLtc));
        }
    }
    return sum / (steps * steps);
}

double discrimination(GgxLobe const& lobe, LtcTerms const& terms) {
    if (!(terms.a > 1e-9 && terms.d > 1e-9)) return 2; // no lobe
    return compare(lobe, terms, kFitSteps,
                   [](double f, double g) { return f + g > 0 ? lib::sq((f - g) / (f + g)) : 0; });
}

struct Point {
    std::array<double, 3> x{};
    double error = 0;
};

LtcTerms termsOf(Point const& point) { return { point.x[0], point.x[1], point.x[2] }; }

/// The simplex method in the terms where `step` is not 0.
class Simplex {
public:
    Simplex(GgxLobe const& lobe, LtcTerms const& start, std::array<double, 3> const& step) : mLobe(lobe) {
        add({ start.a, start.b, start.d });
        for (size_t i = 0; i < step.size(); ++i) {
            if (step[i] == 0) continue;
            std::array<double, 3> x{ start.a, start.b, start.d };
            x[i] += step[i];
            add(x);
        }
    }

    LtcTerms minimum() {
        for (int move = 0; move < kMaxMoves; ++move) {
            std::ranges::sort(mPoints, {}, &Point::error);
            if (mPoints.back().error - mPoints.front().error < kConverged) break;
            step();
        }
        return termsOf(*std::ranges::min_element(mPoints, {}, &Point::error));
    }

private:
    Point at(std::array<double, 3> const& x) const {
        Point point{ x, 0 };
        point.error = discrimination(mLobe, termsOf(point));
        return point;
    }

    void add(std::array<double, 3> const& x) { mPoints.push_back(at(x)); }

    /// On the line from the worst point through the centre of the others; 1: the centre, 2: as far beyond it.
    Point along(double distance) const {
        std::array<double, 3> x{};
        Point const& worst = mPoints.back();
        for (size_t i = 0; i < x.size(); ++i) {
            double center = 0;
            for (size_t p = 0; p + 1 < mPoints.size(); ++p) center += mPoints[p].x[i];
            center /= static_cast<double>(mPoints.size() - 1);
            x[i] = worst.x[i] + distance * (center - worst.x[i]);
        }
        return at(x);
    }

    void step() {
        Point& worst = mPoints.back();
        const Point reflected = along(2);
        if (reflected.error < mPoints.front().error) {
            const Point expanded = along(3);
            worst = expanded.error < reflected.error ? expanded : reflected;
        } else if (reflected.error < mPoints[mPoints.size() - 2].error) {
            worst = reflected;
        } else {
            const Point contracted = along(reflected.error < worst.error ? 1.5 : 0.5);
            if (contracted.error < std::min(reflected.error, worst.error))
                worst = contracted;
            else
                shrink();
        }
    }

    void shrink() {
        for (size_t p = 1; p < mPoints.size(); ++p) {
            std::array<double, 3> x{};
            for (size_t i = 0; i < x.size(); ++i) x[i] = 0.5 * (mPoints[0].x[i] + mPoints[p].x[i]);
            mPoints[p] = at(x);
        }
    }

    GgxLobe const& mLobe;
    std::vector<Point> mPoints;
};

} // namespace

GgxLobe::GgxLobe(double nov, double perceptualRoughness)
        : mAlpha(lib::alphaFromPerceptual(perceptualRoughness)), mView(std::sqrt((1 - nov) * (1 + nov)), 0, nov) {
    FILAMENT_ASSERT(nov > 0 && nov <= 1 && perceptualRoughness > 0 && perceptualRoughness <= 1,
                    "a lobe has 0 < nov <= 1 and 0 < roughness <= 1");
    double sum = 0;
    for (int i = 0; i < kNormSteps; ++i) {
        for (int j = 0; j < kNormTurns; ++j) {
            const double3 light = sample((i + 0.5) / kNormSteps, (j + 0.5) / kNormTurns);
            if (light.z > 0) sum += weight(light);
        }
    }
    mNorm = sum / (kNormSteps * kNormTurns);
}

double GgxLobe::value(double3 light) const {
    if (light.z <= 0) return 0;
    return lib::ndfGgxFromVectors({ 0, 0, 1 }, glm::normalize(mView + light), mAlpha) *
           lib::visibilitySmithGgxCorrelated(mView.z, light.z, mAlpha) * light.z;
}

double3 GgxLobe::sample(double u, double v) const {
    const double3 stretched = glm::normalize(double3(mAlpha, mAlpha, 1) * mView);
    const double z = 1 - u * (1 + stretched.z), radius = std::sqrt(std::max(1 - z * z, 0.0)), angle = lib::kPi * v;
    const double3 cap = stretched + double3(radius * std::cos(angle), radius * std::sin(angle), z);
    const double3 facet = glm::normalize(double3(mAlpha, mAlpha, 1) * cap);
    return facet * (2 * glm::dot(mView, facet)) - mView;
}

double GgxLobe::weight(double3 light) const {
    const double a2 = mAlpha * mAlpha, nov = mView.z;
    const double masking = 2 * nov / (nov + std::sqrt(a2 + (1 - a2) * nov * nov));
    return lib::visibilitySmithGgxCorrelated(nov, light.z, mAlpha) * 4 * light.z * nov / masking;
}

LtcTerms mirrorTerms(double nov, double alpha) {
    const lib::vec3 terms = lib::ltcTransformation({ 0, 0, 1 }, nov, alpha);
    return { terms.x, terms.y, terms.z };
}

LtcTerms fitLtc(GgxLobe const& lobe, LtcTerms start) {
    const bool isRound = lobe.nov() == 1; // a circle around the normal
    LtcTerms terms = start;
    for (int run = 0; run < kRestarts; ++run) {
        const std::array<double, 3> step{ isRound ? 0 : 0.05 * terms.a,
                                          isRound ? 0 : 0.02 * std::abs(terms.b) + 0.01 * lobe.alpha(),
                                          0.05 * terms.d };
        terms = Simplex(lobe, terms, step).minimum();
    }
    return terms;
}

double totalVariation(GgxLobe const& lobe, LtcTerms terms) {
    return 0.5 * compare(lobe, terms, kVariationSteps,
                         [](double f, double g) { return f + g > 0 ? std::abs(f - g) / (f + g) : 0; });
}

std::vector<float3> fitLtcTable(int size) {
    std::vector<float3> table;
    for (int row = 0; row < size; ++row) {
        const double roughness = lib::kLtcMinRoughness + (1 - lib::kLtcMinRoughness) * row / (size - 1);
        double3 entry(0, 0, 1); // of the neighbour
        for (int column = 0; column < size; ++column) {
            const double nov = std::max(1 - lib::sq(column / (size - 1.0)), kNearestToGrazing);
            const GgxLobe lobe(nov, roughness);
            const LtcTerms mirror = mirrorTerms(nov, lobe.alpha());
            const LtcTerms terms =
                    fitLtc(lobe, { std::max(mirror.a + entry.x, 1e-6), mirror.b + entry.y, mirror.d * entry.z });
            entry = { terms.a - mirror.a, terms.b - mirror.b, terms.d / mirror.d };
            table.emplace_back(entry);
        }
    }
    return table;
}

LtcTerms lookUpLtc(const float* table, double nov, double perceptualRoughness) {
    const lib::vec2 at = lib::ltcCoordinates(nov, perceptualRoughness);
    const int size = lib::kLtcTableSize;
    const int column = std::min(static_cast<int>(at.x), size - 2), row = std::min(static_cast<int>(at.y), size - 2);
    const double right = at.x - column, below = at.y - row;
    const auto entry = [&](int x, int y) {
        const float* values = table + (y * size + x) * 3;
        return double3(values[0], values[1], values[2]);
    };
    const double3 upper = glm::mix(entry(column, row), entry(column + 1, row), right);
    const double3 lower = glm::mix(entry(column, row + 1), entry(column + 1, row + 1), right);
    const lib::vec3 terms =
            lib::ltcTransformation(glm::mix(upper, lower, below), nov, lib::alphaFromPerceptual(perceptualRoughness));
    return { terms.x, terms.y, terms.z };
}

} // namespace filament_core::tools

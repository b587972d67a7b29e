// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/FitField.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

using scene::GridRecord;
using scene::GridSample;
using scene::sampleGrid;
using scene::spacingOf;

/// Points on a wall that is a face of the box are beside it by their rounding.
constexpr float kLeastGridBlendMeters = 1e-3f;
/// A point with less of its probes does not count: what is left of them is a tail of the visibility of all.
constexpr float kLeastWeight = 0.02f;
/// What is darker than this share of the mean counts as if it were as bright: see importanceOf().
constexpr float kDarkShare = 0.02f;
/// How strongly gradients that no point determines go to 0.
constexpr double kRidge = 1e-9;

float luminance(float3 color) { return glm::dot(color, float3(0.2126f, 0.7152f, 0.0722f)); }

/// As probeWeight() of shaders/lib/probes.glsl.
float shareOf(GridRecord const& grid, float3 local) {
    const float3 outside = glm::abs(local) - grid.halfExtent;
    const float farthest = std::max({ outside.x, outside.y, outside.z });
    return std::clamp(1 - farthest / std::max(grid.blendMeters, kLeastGridBlendMeters), 0.0f, 1.0f);
}

struct PointLight {
    IrradianceSh light{};
    float weight = 0;
};

class Fit {
public:
    Fit(std::span<GridRecord const* const> grids, IrradianceSh const& environment, FieldBox const& box)
            : mGrids(grids), mEnvironment(environment), mBox(box) {
        const float3 spacing = spacingOf(*grids.front());
        const float finest = std::min({ spacing.x, spacing.y, spacing.z });
        for (int axis = 0; axis < 3; ++axis)
            mCount[axis] = static_cast<uint32_t>(std::clamp(2 * box.halfExtent[axis] / finest + 2, 2.0f, 8.0f));
    }

    /// False: no point counts.
    bool run(bool seesThroughWalls, LightField& field) {
        mNormal = {};
        mRight = {};
        mConstant = {};
        mSum = mWeights = mMean = 0;
        visit(seesThroughWalls, [&](float3, PointLight const& point) {
            mWeights += static_cast<double>(point.weight);
            mMean += static_cast<double>(point.weight * luminance(point.light[0]));
        });
        visit(seesThroughWalls, [&](float3 u, PointLight const& point) { add(u, point); });
        if (mSum <= 0) return false;
        solve(field);
        double squares = 0;
        visit(seesThroughWalls, [&](float3 u, PointLight const& point) {
            float3 fitted = field.middle[0];
            for (size_t axis = 0; axis < 3; ++axis) fitted += field.change[0][axis] * u[static_cast<int>(axis)];
            const double lacks = luminance(fitted - point.light[0]);
            squares += static_cast<double>(point.weight) * lacks * lacks;
        });
        field.error = mMean > 0 ? static_cast<float>(std::sqrt(squares / mWeights) / (mMean / mWeights)) : 0.0f;
        return true;
    }

private:
    using Row = std::array<double, 4>; // of 1, u.x, u.y, u.z

    template <class Visit>
    void visit(bool seesThroughWalls, Visit const& to) const {
        for (uint32_t z = 0; z < mCount.z; ++z)
            for (uint32_t y = 0; y < mCount.y; ++y)
                for (uint32_t x = 0; x < mCount.x; ++x) {
                    const float3 u = 2.0f * float3(uint3(x, y, z)) / float3(mCount - 1u) - 1.0f;
                    const PointLight point = lightAt(u, seesThroughWalls);
                    if (point.weight > 0) to(u, point);
                }
    }

    PointLight lightAt(float3 u, bool seesThroughWalls) const {
        PointLight point;
        float left = 1;
        for (GridRecord const* grid : mGrids) {
            const float3 fromCenter = float3(mBox.centerWorld - grid->centerWorld) + u * mBox.halfExtent;
            const float3 local = fromCenter * grid->worldFromBox;
            const float share = std::min(shareOf(*grid, local), left);
            if (share <= 0) continue;
            left -= share;
            const GridSample sample = sampleGrid(*grid, local, seesThroughWalls);
            if (sample.weight < kLeastWeight) continue;
            point.weight += share * sample.weight;
            for (size_t i = 0; i < point.light.size(); ++i) point.light[i] += share * sample.weight * sample.light[i];
        }
        point.weight += left;
        for (size_t i = 0; i < point.light.size(); ++i) point.light[i] += left * mEnvironment[i];
        if (point.weight < kLeastWeight) return {};
        for (float3& coefficient : point.light) coefficient /= point.weight;
        return point;
    }

    /// Errors count in shares of the light of their point: light of a wall's bright side is seen on its dark side.
    double importanceOf(PointLight const& point) const {
        const double mean = mMean / mWeights, dark = kDarkShare * mean;
        const double light = mean > 0 ? std::max(static_cast<double>(luminance(point.light[0])), dark) / mean : 1;
        return static_cast<double>(point.weight) / (light * light);
    }

    void add(float3 u, PointLight const& point) {
        const Row basis{ 1, u.x, u.y, u.z };
        const double weight = importanceOf(point);
        for (size_t i = 0; i < 4; ++i) {
            for (size_t j = 0; j < 4; ++j) mNormal[i][j] += weight * basis[i] * basis[j];
            for (size_t k = 0; k < 4; ++k) mRight[i][k] += weight * basis[i] * double3(point.light[k]);
        }
        for (size_t k = 0; k < 5; ++k) mConstant[k] += weight * double3(point.light[k + 4]);
        mSum += weight;
    }

    /// The normal equations, by elimination: with the ridge their matrix is positive definite.
    void solve(LightField& field) {
        for (size_t i = 1; i < 4; ++i) mNormal[i][i] += kRidge * mSum;
        for (size_t i = 0; i < 4; ++i) {
            for (size_t row = i + 1; row < 4; ++row) {
                const double factor = mNormal[row][i] / mNormal[i][i];
                for (size_t j = i; j < 4; ++j) mNormal[row][j] -= factor * mNormal[i][j];
                for (size_t k = 0; k < 4; ++k) mRight[row][k] -= factor * mRight[i][k];
            }
        }
        for (size_t k = 0; k < 4; ++k) {
            std::array<double3, 4> solved{};
            for (size_t i = 4; i-- > 0;) {
                double3 value = mRight[i][k];
                for (size_t j = i + 1; j < 4; ++j) value -= mNormal[i][j] * solved[j];
                solved[i] = value / mNormal[i][i];
            }
            field.middle[k] = float3(solved[0]);
            for (size_t axis = 0; axis < 3; ++axis) field.change[k][axis] = float3(solved[axis + 1]);
        }
        for (size_t k = 0; k < 5; ++k) field.constant[k] = float3(mConstant[k] / mSum);
    }

    std::span<GridRecord const* const> mGrids;
    IrradianceSh const& mEnvironment;
    FieldBox const& mBox;
    uint3 mCount{ 2 };
    std::array<Row, 4> mNormal{};
    std::array<std::array<double3, 4>, 4> mRight{}; // by basis function, then coefficient
    std::array<double3, 5> mConstant{};
    double mSum = 0;                // of importances
    double mWeights = 0, mMean = 0; // of weights, and of their products with luminances
};

} // namespace

bool reaches(GridRecord const& grid, FieldBox const& box) {
    const float3 local = float3(box.centerWorld - grid.centerWorld) * grid.worldFromBox;
    const float reach = std::max(grid.blendMeters, kLeastGridBlendMeters);
    for (int axis = 0; axis < 3; ++axis) {
        const float half = glm::dot(glm::abs(grid.worldFromBox[axis]), box.halfExtent);
        if (!(std::abs(local[axis]) < grid.halfExtent[axis] + reach + half)) return false;
    }
    return true;
}

LightField fitField(std::span<GridRecord const* const> grids, IrradianceSh const& environment, FieldBox const& box) {
    LightField field;
    Fit fit(grids, environment, box);
    // A box that no probe sees still needs light: that of the probes around it, and else the environment's.
    if (fit.run(false, field) || fit.run(true, field)) return field;
    std::copy_n(environment.begin(), 4, field.middle.begin());
    std::copy_n(environment.begin() + 4, 5, field.constant.begin());
    return field;
}

} // namespace filament_core::prepare

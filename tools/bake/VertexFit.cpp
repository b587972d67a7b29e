// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/VertexFit.h"

#include <algorithm>
#include <array>
#include <map>

namespace filament_core::bake {
namespace {

constexpr double kPull = 1e-3;        // of edges, beside the texels of a vertex
constexpr uint32_t kMostSteps = 2000; // far more than smooth values need
constexpr double kResidual = 1e-10;   // of squares, at which the fit ends
constexpr uint32_t kRamp = 256;

/// Vertices of one place and normal, as one.
std::vector<uint32_t> mergedVertices(BakeSurface const& surface, uint32_t& count) {
    std::map<std::array<double, 6>, uint32_t> known;
    std::vector<uint32_t> merged;
    for (size_t i = 0; i < surface.positions.size(); ++i) {
        double3 const& p = surface.positions[i];
        const double3 n = surface.normals.empty() ? double3(0.0) : surface.normals[i];
        merged.push_back(known.try_emplace({ p.x, p.y, p.z, n.x, n.y, n.z }, count).first->second);
        if (merged.back() == count) ++count;
    }
    return merged;
}

/// A sum of squares of linear terms in unknowns: (weights . x - value)^2 each.
class LeastSquares {
public:
    explicit LeastSquares(size_t unknowns) : mDiagonal(unknowns, 0.0), mRight(unknowns, double4(0.0)) {}

    void add(std::array<uint32_t, 3> const& at, std::array<double, 3> const& weights, double4 value) {
        for (size_t i = 0; i < 3; ++i) {
            mDiagonal[at[i]] += weights[i] * weights[i];
            mRight[at[i]] += weights[i] * value;
            for (size_t k = 0; k < 3; ++k) {
                if (k != i) addProduct(at[i], at[k], weights[i] * weights[k]);
            }
        }
    }
    void pullTogether(uint32_t a, uint32_t b, double weight) {
        if (a == b) return;
        mDiagonal[a] += weight, mDiagonal[b] += weight;
        addProduct(a, b, -weight), addProduct(b, a, -weight);
    }
    double meanDiagonal() const {
        double sum = 0;
        for (const double one : mDiagonal) sum += one;
        return mDiagonal.empty() ? 0 : sum / double(mDiagonal.size());
    }

    /// From `start`; conjugate gradients, preconditioned by the diagonal (Saad 2003, "Iterative Methods for Sparse
    /// Linear Systems", algorithm 9.1), for the four components at once.
    std::vector<double4> solve(double4 start) const {
        const size_t n = mDiagonal.size();
        const Others others(mOthers.begin(), mOthers.end());
        std::vector<double4> x(n, start), r(n), z(n), p(n), q(n);
        multiply(others, x, q);
        for (size_t i = 0; i < n; ++i) r[i] = mRight[i] - q[i], z[i] = scaled(r[i], i), p[i] = z[i];
        double4 rz = product(r, z);
        const double4 first = glm::max(rz, double4(1e-300));
        for (uint32_t step = 0; step < kMostSteps && !isSmall(rz, first); ++step) {
            multiply(others, p, q);
            const double4 alpha = quotient(rz, product(p, q));
            for (size_t i = 0; i < n; ++i) x[i] += alpha * p[i], r[i] -= alpha * q[i], z[i] = scaled(r[i], i);
            const double4 next = product(r, z), beta = quotient(next, rz);
            for (size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
            rz = next;
        }
        return x;
    }

private:
    using Place = std::pair<uint32_t, uint32_t>; // row and column
    using Others = std::vector<std::pair<Place, double>>;

    void addProduct(uint32_t row, uint32_t column, double value) { mOthers[{ row, column }] += value; }
    double4 scaled(double4 value, size_t i) const { return mDiagonal[i] > 0 ? value / mDiagonal[i] : double4(0.0); }
    void multiply(Others const& others, std::vector<double4> const& x, std::vector<double4>& result) const {
        for (size_t i = 0; i < x.size(); ++i) result[i] = mDiagonal[i] * x[i];
        for (auto const& [place, value] : others) result[place.first] += value * x[place.second];
    }
    static double4 product(std::vector<double4> const& a, std::vector<double4> const& b) {
        double4 sum(0.0);
        for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }
    static double4 quotient(double4 a, double4 b) {
        double4 result(0.0);
        for (int i = 0; i < 4; ++i) result[i] = b[i] > 0 ? a[i] / b[i] : 0; // a component that is done stays
        return result;
    }
    static bool isSmall(double4 rz, double4 first) {
        for (int i = 0; i < 4; ++i) {
            if (rz[i] > kResidual * first[i]) return false;
        }
        return true;
    }

    std::vector<double> mDiagonal;
    std::vector<double4> mRight;
    std::map<Place, double> mOthers; // in order: sums have the same bits on every machine
};

std::array<double, 3> weightsOf(AtlasTexel const& texel) { return { 1 - texel.u - texel.v, texel.u, texel.v }; }

/// Of one surface; `used`: the numbers of its texels.
std::vector<double4> fitSurface(BakeSurface const& surface, std::span<const AtlasTexel> texels,
                                std::span<const TexelLight> lights, std::span<const uint32_t> used) {
    uint32_t unknowns = 0;
    const std::vector<uint32_t> merged = mergedVertices(surface, unknowns);
    LeastSquares squares(unknowns);
    double4 mean(0.0);
    const auto cornersOf = [&](size_t triangle) {
        const uint32_t* const corners = &surface.indices[triangle * 3];
        return std::array{ merged[corners[0]], merged[corners[1]], merged[corners[2]] };
    };
    for (const uint32_t i : used) {
        const double4 value(lights[i].irradiance.x, lights[i].open);
        squares.add(cornersOf(texels[i].triangle), weightsOf(texels[i]), value);
        mean += value / double(used.size());
    }
    if (used.empty()) mean = double4(1, 0, 0, 0);
    const double pull = used.empty() ? 1 : kPull * squares.meanDiagonal();
    for (size_t t = 0; t * 3 < surface.indices.size(); ++t) {
        const auto corners = cornersOf(t);
        for (size_t k = 0; k < 3; ++k) squares.pullTogether(corners[k], corners[(k + 1) % 3], pull);
    }
    const std::vector<double4> solved = squares.solve(mean);
    std::vector<double4> values;
    for (const uint32_t i : merged) {
        values.push_back(solved[i]);
        values.back().x = std::clamp(values.back().x, 0.0, 1.0);
    }
    return values;
}

} // namespace

VertexOcclusion fitVertices(std::span<const BakeSurface> surfaces, Atlas const& atlas,
                            std::span<const AtlasTexel> texels, std::span<const TexelLight> lights) {
    std::vector<std::vector<uint32_t>> used(surfaces.size());
    for (uint32_t i = 0; i < texels.size(); ++i) { // those around a chart would count its border twice
        if (texels[i].distance == 0 && lights[i].backs <= kMostBacks)
            used[atlas.charts[texels[i].chart].surface].push_back(i);
    }
    VertexOcclusion values;
    for (size_t i = 0; i < surfaces.size(); ++i) values.push_back(fitSurface(surfaces[i], texels, lights, used[i]));
    return values;
}

LightmapImage visibleOf(VertexOcclusion const& values, std::span<const BakeSurface> surfaces, Atlas const& atlas,
                        std::span<const AtlasTexel> texels, std::span<const TexelLight> lights) {
    std::vector<TexelLight> given(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(texels.size()));
    for (size_t i = 0; i < texels.size(); ++i) {
        const uint32_t surface = atlas.charts[texels[i].chart].surface;
        const uint32_t* const corners = &surfaces[surface].indices[size_t(texels[i].triangle) * 3];
        double visible = 0;
        for (size_t k = 0; k < 3; ++k) visible += weightsOf(texels[i])[k] * values[surface][corners[k]].x;
        given[i].irradiance = double3(visible);
    }
    LightmapImage image = makeImage(atlas, texels, given);
    image.intensity = 1;
    image.smaller.clear();
    return image;
}

Atlas rampAtlas(VertexOcclusion const& values, std::span<const BakeSurface> surfaces) {
    Atlas atlas{ .side = kRamp };
    for (size_t i = 0; i < surfaces.size(); ++i) {
        AtlasSurface surface{ .indices = surfaces[i].indices };
        for (uint32_t vertex = 0; vertex < values[i].size(); ++vertex) {
            surface.sources.push_back(vertex);
            const double u = (values[i][vertex].x * (kRamp - 1) + 0.5) / kRamp;
            surface.uvs.push_back({ static_cast<float>(u), 0.5f });
        }
        atlas.surfaces.push_back(std::move(surface));
    }
    return atlas;
}

std::vector<std::byte> rampTexels() {
    std::vector<std::byte> texels;
    for (uint32_t i = 0; i < kRamp; ++i) {
        texels.insert(texels.end(), 3, static_cast<std::byte>(i));
        texels.push_back(std::byte{ 255 });
    }
    return texels;
}

} // namespace filament_core::bake

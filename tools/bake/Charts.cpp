// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <unordered_map>

namespace filament_core::bake {
namespace {

constexpr uint32_t kNoChart = ~0u;
constexpr double kDegenerateArea = 1e-12; // of the square of the mesh's size
constexpr double kTouching = 1e-7;        // of the mesh's size: triangles that share an edge touch
constexpr int kTurns = 16;                // tried of a quarter turn, besides the edges of the first triangle

/// Triangles of a chart by the cells of a grid that their boxes touch.
class PlaneGrid {
public:
    explicit PlaneGrid(double cell) : mCell(cell) {}

    void add(std::array<double2, 3> const& corners) {
        const auto index = static_cast<uint32_t>(mTriangles.size());
        mTriangles.push_back(corners);
        visitCells(corners, [&](uint64_t cell) {
            mCells[cell].push_back(index);
            return true;
        });
    }

    bool overlaps(std::array<double2, 3> const& corners, double tolerance) const {
        return !visitCells(corners, [&](uint64_t cell) {
            const auto found = mCells.find(cell);
            return found == mCells.end() || std::ranges::none_of(found->second, [&](uint32_t other) {
                       return overlap(corners, mTriangles[other], tolerance);
                   });
        });
    }

private:
    /// Of the triangle's box, until `visit` returns false.
    template <class Visit>
    bool visitCells(std::array<double2, 3> const& corners, Visit const& visit) const {
        const double2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]) / mCell;
        const double2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]) / mCell;
        for (auto y = static_cast<int64_t>(std::floor(low.y)); y <= static_cast<int64_t>(std::floor(high.y)); ++y) {
            for (auto x = static_cast<int64_t>(std::floor(low.x)); x <= static_cast<int64_t>(std::floor(high.x)); ++x) {
                const uint64_t cell = (static_cast<uint64_t>(x) << 32) ^ (static_cast<uint64_t>(y) & 0xffffffffu);
                if (!visit(cell)) return false;
            }
        }
        return true;
    }

    double mCell;
    std::vector<std::array<double2, 3>> mTriangles;
    std::unordered_map<uint64_t, std::vector<uint32_t>> mCells;
};

struct Plane {
    double3 normal{ 0, 0, 1 }, x{ 1, 0, 0 }, y{ 0, 1, 0 };
    double2 operator()(double3 point) const { return { glm::dot(point, x), glm::dot(point, y) }; }
};

/// x along the edge a-b.
Plane planeOf(double3 normal, double3 edge) {
    Plane plane{ .normal = normal };
    const double3 x = edge - normal * glm::dot(normal, edge);
    plane.x = glm::normalize(x);
    plane.y = glm::cross(normal, plane.x);
    return plane;
}

class Cutter {
public:
    Cutter(std::span<const double3> positions, std::span<const uint32_t> indices, ChartOptions const& options)
            : mPositions(positions), mIndices(indices), mOptions(options), mCount(indices.size() / 3),
              mChartOf(mCount, kNoChart) {
        measure();
        findNeighbours();
    }

    std::vector<Chart> cut() {
        std::vector<uint32_t> order(mCount);
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) { return mAreas[a] > mAreas[b]; });
        for (const uint32_t triangle : order) {
            if (mChartOf[triangle] == kNoChart && isFlat(triangle)) grow(triangle);
        }
        for (const uint32_t triangle : order) {
            if (mChartOf[triangle] == kNoChart) placeDegenerate(triangle);
        }
        for (Chart& chart : mCharts) turn(chart);
        return std::move(mCharts);
    }

private:
    double3 corner(uint32_t triangle, uint32_t i) const { return mPositions[mIndices[triangle * 3 + i]]; }
    bool isFlat(uint32_t triangle) const { return mAreas[triangle] > kDegenerateArea * mSize * mSize; }

    void measure() {
        double3 low(1e300), high(-1e300);
        for (const uint32_t index : mIndices) {
            low = glm::min(low, mPositions[index]);
            high = glm::max(high, mPositions[index]);
        }
        mSize = mCount > 0 ? glm::length(high - low) : 0;
        double squares = 0;
        for (uint32_t i = 0; i < mCount; ++i) {
            const double3 normal = glm::cross(corner(i, 1) - corner(i, 0), corner(i, 2) - corner(i, 0));
            const double length = glm::length(normal);
            mAreas.push_back(length / 2);
            mNormals.push_back(length > 0 ? normal / length : double3(0.0));
            const double3 edge = longestEdge(i);
            squares += glm::dot(edge, edge);
        }
        // A triangle then lies in few cells on average, however thin they all are.
        mCell = std::max(std::sqrt(squares / std::max<double>(double(mCount), 1)), mSize / 1024);
        if (!(mCell > 0)) mCell = 1;
    }

    /// Vertices with equal positions are one here: seams of normals and textures do not part a surface.
    void findNeighbours() {
        std::map<std::array<double, 3>, uint32_t> places;
        std::vector<uint32_t> place(mPositions.size(), 0);
        for (const uint32_t index : mIndices) {
            const double3 p = mPositions[index];
            place[index] = places.try_emplace({ p.x, p.y, p.z }, static_cast<uint32_t>(places.size())).first->second;
        }
        std::unordered_map<uint64_t, std::vector<uint32_t>> edges;
        const auto edgeOf = [&](uint32_t triangle, uint32_t i) {
            const uint32_t a = place[mIndices[triangle * 3 + i]], b = place[mIndices[triangle * 3 + (i + 1) % 3]];
            return (uint64_t(std::min(a, b)) << 32) | std::max(a, b);
        };
        for (uint32_t triangle = 0; triangle < mCount; ++triangle) {
            for (uint32_t i = 0; i < 3; ++i) edges[edgeOf(triangle, i)].push_back(triangle);
        }
        mNeighbours.resize(mCount);
        for (uint32_t triangle = 0; triangle < mCount; ++triangle) {
            for (uint32_t i = 0; i < 3; ++i) {
                for (const uint32_t other : edges[edgeOf(triangle, i)]) {
                    if (other != triangle) mNeighbours[triangle].push_back(other);
                }
            }
        }
    }

    void grow(uint32_t seed) {
        const auto index = static_cast<uint32_t>(mCharts.size());
        const Plane plane = planeOf(mNormals[seed], longestEdge(seed));
        Chart& chart = mCharts.emplace_back();
        mPlanes.push_back(plane);
        PlaneGrid grid(mCell);
        std::deque<uint32_t> next{ seed };
        while (!next.empty()) {
            const uint32_t triangle = next.front();
            next.pop_front();
            if (mChartOf[triangle] != kNoChart) continue;
            const std::array corners{ plane(corner(triangle, 0)), plane(corner(triangle, 1)),
                                      plane(corner(triangle, 2)) };
            if (glm::dot(mNormals[triangle], plane.normal) < mOptions.leastCosine) continue;
            if (grid.overlaps(corners, kTouching * mSize)) continue;
            grid.add(corners);
            mChartOf[triangle] = index;
            chart.triangles.push_back(triangle);
            chart.corners.insert(chart.corners.end(), corners.begin(), corners.end());
            for (const uint32_t other : mNeighbours[triangle]) {
                if (mChartOf[other] == kNoChart && isFlat(other)) next.push_back(other);
            }
        }
    }

    double3 longestEdge(uint32_t triangle) const {
        double3 longest(0.0);
        for (uint32_t i = 0; i < 3; ++i) {
            const double3 edge = corner(triangle, (i + 1) % 3) - corner(triangle, i);
            if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
        }
        return longest;
    }

    /// In the plane of a neighbour, where its corners coincide with those of the neighbour.
    void placeDegenerate(uint32_t triangle) {
        for (const uint32_t other : mNeighbours[triangle]) {
            const uint32_t chart = mChartOf[other];
            if (chart == kNoChart || !isFlat(other)) continue;
            mChartOf[triangle] = chart;
            mCharts[chart].triangles.push_back(triangle);
            for (uint32_t i = 0; i < 3; ++i) mCharts[chart].corners.push_back(mPlanes[chart](corner(triangle, i)));
            return;
        }
        mChartOf[triangle] = static_cast<uint32_t>(mCharts.size());
        mCharts.push_back({ { triangle }, std::vector<double2>(3, double2(0.0)) });
        mPlanes.push_back({});
    }

    /// To the smallest box among some turns; its corner becomes the origin.
    static void turn(Chart& chart) {
        std::vector<double2> directions;
        for (uint32_t i = 0; i < 3; ++i) {
            const double2 edge = chart.corners[(i + 1) % 3] - chart.corners[i];
            if (glm::length(edge) > 0) directions.push_back(glm::normalize(edge));
        }
        for (int i = 0; i < kTurns; ++i) {
            const double t = double(i) / kTurns; // rational points of a quarter of the circle
            directions.emplace_back((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t));
        }
        double2 best(1, 0), low(0.0);
        double smallest = -1;
        for (const double2 x : directions) {
            const auto [least, most] = boxOf(chart, x);
            const double area = (most.x - least.x) * (most.y - least.y);
            if (smallest >= 0 && area >= smallest * (1 - 1e-9)) continue;
            smallest = area, best = x, low = least, chart.size = most - least;
        }
        for (double2& corner : chart.corners) corner = turned(corner, best) - low;
    }

    static double2 turned(double2 p, double2 x) { return { glm::dot(p, x), p.y * x.x - p.x * x.y }; }
    static std::pair<double2, double2> boxOf(Chart const& chart, double2 x) {
        double2 low(1e300), high(-1e300);
        for (const double2 corner : chart.corners) {
            low = glm::min(low, turned(corner, x));
            high = glm::max(high, turned(corner, x));
        }
        return { low, high };
    }

    std::span<const double3> mPositions;
    std::span<const uint32_t> mIndices;
    ChartOptions mOptions;
    size_t mCount;
    double mSize = 0, mCell = 0;
    std::vector<double> mAreas;
    std::vector<double3> mNormals;
    std::vector<std::vector<uint32_t>> mNeighbours;
    std::vector<uint32_t> mChartOf;
    std::vector<Chart> mCharts;
    std::vector<Plane> mPlanes;
};

/// Whether an edge of `a` has all of `b` on its outer side.
bool isParted(std::span<const double2, 3> a, std::span<const double2, 3> b, double tolerance) {
    for (size_t i = 0; i < 3; ++i) {
        const double2 from = a[i], edge = a[(i + 1) % 3] - from;
        const double length = glm::length(edge);
        if (!(length > 0)) continue;
        const bool isOutside = std::ranges::all_of(
                b, [&](double2 p) { return edge.x * (p.y - from.y) - edge.y * (p.x - from.x) <= tolerance * length; });
        if (isOutside) return true;
    }
    return false;
}

} // namespace

double doubleArea(double2 a, double2 b, double2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Separating axes of convex shapes: in two dimensions those of their edges (Gottschalk, Lin, Manocha 1996,
// "OBBTree", section 5).
bool overlap(std::span<const double2, 3> a, std::span<const double2, 3> b, double tolerance) {
    return !isParted(a, b, tolerance) && !isParted(b, a, tolerance);
}

std::vector<Chart> makeCharts(std::span<const double3> positions, std::span<const uint32_t> indices,
                              ChartOptions const& options) {
    return Cutter(positions, indices, options).cut();
}

} // namespace filament_core::bake

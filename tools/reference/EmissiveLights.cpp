// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/EmissiveLights.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Material.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

constexpr uint32_t kNone = ~0u;

double areaOf(Part const& part, uint32_t triangle) {
    const auto corner = [&](uint32_t i) { return double3(part.positions[part.indices[triangle * 3 + i]]); };
    return 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

bool glows(assets::MaterialData const& material) {
    if (material.unlit) return true;
    const float3 emitted = material.emissiveFactor * material.emissiveStrength;
    return emitted.x > 0 || emitted.y > 0 || emitted.z > 0;
}

/// Radiance towards `view`; zero where a mask cuts the surface away.
double3 emittedAt(Part const& part, TrianglePoint const& point, double3 view) {
    return isMaskedOut(part, point) ? double3(0.0) : surfaceAt(part, point, view).emitted;
}

double meanEmission(Part const& part, uint32_t triangle) {
    constexpr double2 kPoints[] = { { 1.0 / 3, 1.0 / 3 }, { 0.15, 0.15 }, { 0.7, 0.15 }, { 0.15, 0.7 } };
    double sum = 0;
    for (const double2 at : kPoints) {
        const double3 emitted = emittedAt(part, { triangle, at.x, at.y }, faceNormal(part, triangle));
        sum += shader::lib64::luminance(emitted) / std::size(kPoints);
    }
    return std::isfinite(sum) ? std::max(sum, 0.0) : 0;
}

} // namespace

EmissiveLights::EmissiveLights(std::vector<Part> const& parts) : mParts(&parts), mFirstOfPart(parts.size(), kNone) {
    std::vector<double> weights;
    for (uint32_t i = 0; i < parts.size(); ++i) {
        if (glows(*parts[i].material)) addPart(i, weights);
    }
    if (std::ranges::all_of(weights, [](double weight) { return weight <= 0; })) {
        mTriangles.clear();
        return;
    }
    mChoice = Distribution(weights);
}

void EmissiveLights::addPart(uint32_t index, std::vector<double>& weights) {
    Part const& part = (*mParts)[index];
    mFirstOfPart[index] = static_cast<uint32_t>(mTriangles.size());
    for (uint32_t triangle = 0; triangle < part.indices.size() / 3; ++triangle) {
        const double area = areaOf(part, triangle);
        mTriangles.push_back({ index, triangle, area });
        const double weight = area > 0 ? area * meanEmission(part, triangle) : 0;
        weights.push_back(std::isfinite(weight) ? weight : 0); // nodes can scale a triangle beyond the floats
    }
}

double EmissiveLights::density(uint32_t light, double distance, double cosine) const {
    const double probability = mChoice.probability(light);
    return probability > 0 ? probability / mTriangles[light].area * distance * distance / std::max(cosine, 1e-12) : 0;
}

EmissiveSample EmissiveLights::sample(double3 position, double2 u, double choice) const {
    const uint32_t light = mChoice.pick(choice).index;
    Triangle const& triangle = mTriangles[light];
    Part const& part = (*mParts)[triangle.part];
    const double root = std::sqrt(u.x); // uniform in area: Turk 1990, "Generating Random Points in Triangles"
    const TrianglePoint point{ triangle.index, root * (1 - u.y), root * u.y };
    const double3 toLight = varyingsAt(part, point).position - position;
    const double distance = glm::length(toLight);
    if (!(distance > 0)) return {};
    const double3 direction = toLight / distance;
    const double cosine = std::abs(glm::dot(glm::normalize(faceNormal(part, triangle.index)), direction));
    if (!(cosine > 0)) return {};
    return { direction, distance, emittedAt(part, point, -direction), density(light, distance, cosine) };
}

double EmissiveLights::pdf(Hit const& hit, double3 direction) const {
    if (empty() || mFirstOfPart[hit.part] == kNone) return 0;
    const double3 normal = faceNormal((*mParts)[hit.part], hit.point.triangle);
    const double length = glm::length(normal);
    if (!(length > 0)) return 0;
    return density(mFirstOfPart[hit.part] + hit.point.triangle, hit.distance,
                   std::abs(glm::dot(normal, direction)) / length);
}

} // namespace filament_core::reference

// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/LightPictures.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

double3 LightPicture::at(double2 place) const {
    const auto width = static_cast<int64_t>(pixels.width), height = static_cast<int64_t>(pixels.height);
    const double2 texel = place * double2(pixels.width, pixels.height) - 0.5;
    const double2 whole = glm::floor(texel), part = texel - whole;
    const bool isTiled = shape == LightImageShape::Tiled;
    const auto index = [&](double at, int64_t size) {
        const auto i = static_cast<int64_t>(at);
        return isTiled ? (i % size + size) % size : std::clamp<int64_t>(i, 0, size - 1);
    };
    double3 sum(0.0);
    for (int corner = 0; corner < 4; ++corner) {
        const double2 step(corner & 1, corner >> 1);
        int64_t x = index(whole.x + step.x, width), y = index(whole.y + step.y, height);
        if (shape == LightImageShape::Octahedron) { // beyond an edge lies the same edge, from its other end
            const bool beyondX = double(x) != whole.x + step.x, beyondY = double(y) != whole.y + step.y;
            if (beyondX) y = height - 1 - y;
            if (beyondY) x = width - 1 - x;
        }
        const double2 share = glm::mix(1.0 - part, part, step);
        sum += double3(pixels.colors[static_cast<size_t>(y * width + x)]) * (share.x * share.y);
    }
    return sum;
}

double3 LightPicture::towards(double3 direction) const {
    if (shape == LightImageShape::Cube)
        return double3(assets::colorOfCube(pixels, { direction.x, -direction.y, -direction.z }));
    const double3 v = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    double2 place(v.x, v.y);
    if (v.z < 0) place = { std::copysign(1 - std::abs(v.y), v.x), std::copysign(1 - std::abs(v.x), v.y) };
    return at(place * 0.5 + 0.5);
}

LightPicturePtr lightPictureOf(Image const& image, LightImageShape shape) {
    const LightImageDesc desc{
        .width = image.width, .height = image.height, .format = image.format, .pixels = image.pixels, .shape = shape
    };
    return std::make_shared<const LightPicture>(LightPicture{ assets::lightPixels(desc), shape });
}

} // namespace filament_core::reference

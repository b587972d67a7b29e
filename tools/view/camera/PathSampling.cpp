// SPDX-License-Identifier: Apache-2.0
#include "tools/view/camera/PathSampling.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::view {
namespace {

/// What of a camera moves along a curve: position, lens and exposure. Sizes as logarithms; shift as it is.
using Curve = std::array<double, 12>;
constexpr size_t kParallel = 11;

constexpr float kWidestDegrees = 179; // curves swing a little beyond their keys

double logOfSize(float size, float least) {
    return std::log(std::max(static_cast<double>(size), static_cast<double>(least)));
}

Curve curveOf(Camera const& camera) {
    Lens const& lens = camera.lens;
    const double3 p = camera.position();
    const double tangent = std::tan(glm::radians(static_cast<double>(lens.verticalFovDegrees)) / 2);
    return { p.x,
             p.y,
             p.z,
             std::log(tangent),
             logOfSize(lens.nearMeters, 1e-9f),
             logOfSize(lens.farMeters, 1e-9f),
             static_cast<double>(lens.shift.x),
             static_cast<double>(lens.shift.y),
             std::log(static_cast<double>(camera.exposure.aperture)),
             std::log(static_cast<double>(camera.exposure.shutterSeconds)),
             std::log(static_cast<double>(camera.exposure.iso)),
             logOfSize(lens.orthographicHeight, 1e-30f) };
}

Camera cameraOf(Curve const& curve, glm::dquat const& turn, Camera const& before) {
    const auto size = [](double logarithm) { return static_cast<float>(std::exp(logarithm)); };
    Camera camera = before;
    camera.worldFromView = double4x4(glm::mat3_cast(turn));
    camera.worldFromView[3] = double4(curve[0], curve[1], curve[2], 1);
    camera.lens.verticalFovDegrees =
            std::min(static_cast<float>(glm::degrees(2 * std::atan(std::exp(curve[3])))), kWidestDegrees);
    if (before.lens.isOrthographic()) camera.lens.orthographicHeight = size(curve[kParallel]);
    if (before.lens.nearMeters > 0) camera.lens.nearMeters = size(curve[4]);
    camera.lens.farMeters = std::max(size(curve[5]), camera.lens.nearMeters * 1.001f + 1e-6f);
    camera.lens.shift = { static_cast<float>(curve[6]), static_cast<float>(curve[7]) };
    camera.exposure = { .aperture = size(curve[8]), .shutterSeconds = size(curve[9]), .iso = size(curve[10]) };
    return camera;
}

glm::dquat quaternionOf(Camera const& camera) {
    return glm::normalize(glm::quat_cast(glm::dmat3(camera.worldFromView)));
}

/// The rotation vector of a turn of at most half a circle.
double3 logOf(glm::dquat q) {
    if (q.w < 0) q = -q;
    const double3 v(q.x, q.y, q.z);
    const double sine = glm::length(v);
    return v * (sine < 1e-9 ? 2.0 : 2 * std::atan2(sine, q.w) / sine);
}

glm::dquat expOf(double3 const& rotation) {
    const double angle = glm::length(rotation);
    const double3 v = rotation * (angle < 1e-9 ? 0.5 : std::sin(angle / 2) / angle);
    return glm::normalize(glm::dquat(std::cos(angle / 2), v.x, v.y, v.z));
}

/// The keys of a path by any number: those of a closed one repeat.
class Keys {
public:
    explicit Keys(CameraPath const& path) : mPath(path) {}
    int last() const { return static_cast<int>(mPath.keys.size()) - 1; }
    bool has(int i) const { return mPath.isClosed || (i >= 0 && i <= last()); }
    Camera const& camera(int i) const { return mPath.keys[static_cast<size_t>(wrapped(i))].camera; }
    double seconds(int i) const {
        const int round = (i - wrapped(i)) / (last() + 1);
        return mPath.keys[static_cast<size_t>(wrapped(i))].seconds + round * durationOf(mPath);
    }

private:
    int wrapped(int i) const {
        const int count = last() + 1;
        return (i % count + count) % count;
    }
    CameraPath const& mPath;
};

/// The speed of the parabola through three keys at the middle one, from the slopes before and after it. At an end it is
/// that of the parabola through the last three; with two keys the slope between them.
template <class Value, class SlopeOf>
Value speedAt(Keys const& keys, int i, SlopeOf const& slopeOf) {
    const auto lasts = [&](int from) { return keys.seconds(from + 1) - keys.seconds(from); };
    const auto between = [&](int from) { return slopeOf(from) * (1 / lasts(from)); };
    if (keys.has(i - 1) && keys.has(i + 1)) {
        const double before = lasts(i - 1), after = lasts(i);
        return (between(i - 1) * after + between(i) * before) * (1 / (before + after));
    }
    const int near = keys.has(i + 1) ? i : i - 1, far = keys.has(i + 1) ? i + 1 : i - 2;
    if (!keys.has(far) || !keys.has(far + 1)) return between(near);
    const double ofNear = lasts(near), ofFar = lasts(far);
    return between(near) + (between(near) - between(far)) * (ofNear / (ofNear + ofFar));
}

/// Arithmetic of a curve's numbers.
struct Numbers {
    Curve values{};
    friend Numbers operator+(Numbers a, Numbers const& b) {
        for (size_t i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
        return a;
    }
    friend Numbers operator*(Numbers a, double factor) {
        for (double& value : a.values) value *= factor;
        return a;
    }
    friend Numbers operator-(Numbers const& a, Numbers const& b) { return a + b * -1.0; }
};

Numbers numbersOf(Keys const& keys, int i) { return { curveOf(keys.camera(i)) }; }

/// Where the kinds of lens differ, the size of what is seen does not move.
Numbers differenceTo(Keys const& keys, int from) {
    Numbers difference = numbersOf(keys, from + 1) - numbersOf(keys, from);
    if (keys.camera(from).lens.isOrthographic() != keys.camera(from + 1).lens.isOrthographic())
        difference.values[kParallel] = 0;
    return difference;
}

Curve curveBetween(Keys const& keys, int i, double u) {
    const double seconds = keys.seconds(i + 1) - keys.seconds(i);
    const auto slope = [&](int from) { return differenceTo(keys, from); };
    const Numbers begin = speedAt<Numbers>(keys, i, slope) * seconds,
                  end = speedAt<Numbers>(keys, i + 1, slope) * seconds;
    const Numbers whole = differenceTo(keys, i);
    // Hermite's basis, relative to the first key.
    const double u2 = u * u, u3 = u2 * u;
    return (numbersOf(keys, i) + whole * (3 * u2 - 2 * u3) + begin * (u3 - 2 * u2 + u) + end * (u3 - u2)).values;
}

/// Kim, Kim and Shin 1995, section 4.2: q0 exp(w1 b1) exp(w2 b2) exp(w3 b3) with the cumulative Bernstein basis.
glm::dquat turnBetween(Keys const& keys, int i, double u) {
    const auto turn = [&](int from) {
        return logOf(glm::conjugate(quaternionOf(keys.camera(from))) * quaternionOf(keys.camera(from + 1)));
    };
    const double seconds = keys.seconds(i + 1) - keys.seconds(i);
    const double3 first = speedAt<double3>(keys, i, turn) * (seconds / 3);
    const double3 third = speedAt<double3>(keys, i + 1, turn) * (seconds / 3);
    const glm::dquat q0 = quaternionOf(keys.camera(i)), q1 = quaternionOf(keys.camera(i + 1));
    const double3 second = logOf(expOf(-first) * glm::conjugate(q0) * q1 * expOf(-third));
    const double v = 1 - u;
    const double b1 = 1 - v * v * v, b2 = 3 * u * u - 2 * u * u * u, b3 = u * u * u;
    return glm::normalize(q0 * expOf(first * b1) * expOf(second * b2) * expOf(third * b3));
}

} // namespace

double durationOf(CameraPath const& path) {
    if (path.keys.size() < 2) return 0;
    return path.keys.back().seconds - path.keys.front().seconds + (path.isClosed ? path.closingSeconds : 0);
}

Camera sampled(CameraPath const& path, double seconds) {
    if (path.keys.empty()) return {};
    const double duration = durationOf(path);
    if (duration == 0) return path.keys.front().camera;
    if (path.isClosed)
        seconds -= duration * std::floor(seconds / duration);
    else if (seconds <= 0)
        return path.keys.front().camera;
    else if (seconds >= duration)
        return path.keys.back().camera;
    const double time = path.keys.front().seconds + seconds;
    const auto after = std::ranges::upper_bound(path.keys, time, {}, &CameraKey::seconds);
    const int i = std::max(0, static_cast<int>(after - path.keys.begin()) - 1);
    const Keys keys(path);
    if (!keys.has(i + 1) || time == keys.seconds(i)) return keys.camera(i);
    const double u = std::clamp((time - keys.seconds(i)) / (keys.seconds(i + 1) - keys.seconds(i)), 0.0, 1.0);
    return cameraOf(curveBetween(keys, i, u), turnBetween(keys, i, u), keys.camera(i));
}

std::vector<double> frameTimes(CameraPath const& path, double framesPerSecond) {
    const double duration = durationOf(path);
    // A little more than the end, so that rounding does not lose the last frame. A closed path ends where it began.
    const double end = path.isClosed && duration > 0 ? duration * (1 - 1e-9) : duration * (1 + 1e-9);
    std::vector<double> times;
    for (size_t frame = 0; static_cast<double>(frame) / framesPerSecond <= end; ++frame)
        times.push_back(std::min(duration, static_cast<double>(frame) / framesPerSecond));
    return times;
}

} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PathModel.h"

#include "tools/view/camera/PathSampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::view {
namespace {

CameraPath* pathOf(Document& document, PathState& state) {
    return state.path < document.paths.size() ? &document.paths[state.path] : nullptr;
}

void forgetPlace(PathState& state) {
    state.key.reset();
    state.seconds = 0;
    state.isPlaying = false;
}

void look(Document& document, CameraPath const& path, double seconds) {
    if (!path.keys.empty()) document.view.camera = sampled(path, seconds);
}

} // namespace

CameraPath& shownPath(Document& document, PathState& state) {
    if (document.paths.empty()) addPath(document, state);
    if (state.path >= document.paths.size()) {
        state.path = document.paths.size() - 1;
        forgetPlace(state);
    }
    return document.paths[state.path];
}

void addPath(Document& document, PathState& state) {
    const auto isTaken = [&](std::string const& name) {
        return std::ranges::find(document.paths, name, &CameraPath::name) != document.paths.end();
    };
    size_t number = document.paths.size() + 1;
    while (isTaken(fmt::format("path {}", number))) ++number;
    state.path = document.paths.size();
    document.paths.push_back({ .name = fmt::format("path {}", number) });
    forgetPlace(state);
}

void removePath(Document& document, PathState& state) {
    if (state.path >= document.paths.size()) return;
    document.paths.erase(document.paths.begin() + static_cast<ptrdiff_t>(state.path));
    if (state.path > 0) --state.path;
    forgetPlace(state);
}

void addKey(CameraPath& path, PathState& state, Camera const& camera) {
    std::vector<CameraKey>& keys = path.keys;
    if (keys.empty()) {
        keys.push_back({ .seconds = 0, .camera = camera });
        state.key = 0;
        return;
    }
    const size_t before = std::min(state.key.value_or(keys.size() - 1), keys.size() - 1);
    const bool isLast = before + 1 == keys.size();
    const double seconds =
            isLast ? keys[before].seconds + kKeySeconds : (keys[before].seconds + keys[before + 1].seconds) / 2;
    const bool fits = seconds - keys[before].seconds >= kLeastKeySeconds &&
                      (isLast || keys[before + 1].seconds - seconds >= kLeastKeySeconds);
    if (!fits) return;
    keys.insert(keys.begin() + static_cast<ptrdiff_t>(before) + 1, { .seconds = seconds, .camera = camera });
    state.key = before + 1;
}

void replaceKey(CameraPath& path, PathState const& state, Camera const& camera) {
    if (state.key && *state.key < path.keys.size()) path.keys[*state.key].camera = camera;
}

void removeKey(CameraPath& path, PathState& state, size_t key) {
    if (key >= path.keys.size()) return;
    path.keys.erase(path.keys.begin() + static_cast<ptrdiff_t>(key));
    state.isPlaying = false;
    state.seconds = std::clamp(state.seconds, 0.0, durationOf(path));
    if (!state.key) return;
    if (*state.key > key) --*state.key;
    if (*state.key >= path.keys.size()) state.key.reset();
}

void moveKey(CameraPath& path, PathState& state, size_t key, int places) {
    const auto other = static_cast<ptrdiff_t>(key) + (places < 0 ? -1 : 1);
    if (key >= path.keys.size() || other < 0 || other >= static_cast<ptrdiff_t>(path.keys.size())) return;
    std::swap(path.keys[key].camera, path.keys[static_cast<size_t>(other)].camera);
    if (state.key == key)
        state.key = static_cast<size_t>(other);
    else if (state.key == static_cast<size_t>(other))
        state.key = key;
}

void retimeKey(CameraPath& path, size_t key, double seconds) {
    if (key >= path.keys.size() || !std::isfinite(seconds)) return;
    std::vector<CameraKey>& keys = path.keys;
    constexpr double kFarthest = 1e6;
    const double least = key > 0 ? keys[key - 1].seconds + kLeastKeySeconds : -kFarthest;
    const double most = key + 1 < keys.size() ? keys[key + 1].seconds - kLeastKeySeconds : kFarthest;
    if (least <= most) keys[key].seconds = std::clamp(seconds, least, most);
}

void scrubPath(Document& document, PathState& state, double seconds) {
    state.isPlaying = false;
    CameraPath const* const path = pathOf(document, state);
    if (!path) return;
    state.seconds = std::clamp(seconds, 0.0, durationOf(*path));
    look(document, *path, state.seconds);
}

void selectKey(Document& document, PathState& state, size_t key) {
    CameraPath const* const path = pathOf(document, state);
    if (!path || key >= path->keys.size()) return;
    state.key = key;
    scrubPath(document, state, path->keys[key].seconds - path->keys.front().seconds);
    document.view.camera = path->keys[key].camera;
}

void togglePathPlaying(Document& document, PathState& state) {
    CameraPath const* const path = pathOf(document, state);
    state.isPlaying = !state.isPlaying && path && durationOf(*path) > 0;
    if (state.isPlaying && !path->isClosed && state.seconds >= durationOf(*path)) state.seconds = 0;
}

bool playPath(Document& document, PathState& state, double elapsedSeconds) {
    CameraPath const* const path = pathOf(document, state);
    const double duration = path ? durationOf(*path) : 0;
    if (!state.isPlaying || !(duration > 0)) {
        state.isPlaying = false;
        return false;
    }
    state.seconds += elapsedSeconds;
    if (path->isClosed) {
        state.seconds -= duration * std::floor(state.seconds / duration);
    } else if (state.seconds >= duration) {
        state.seconds = duration;
        state.isPlaying = false;
    }
    look(document, *path, state.seconds);
    return true;
}

} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
/// PathModel: what the panel of camera paths does to a path: its keys, and the time at which it is looked at.
///   Times    of keys are those of CameraKey; those of PathState begin with the first key, as sampled() wants them.
///   Thread   any; values.
#pragma once

#include "tools/view/document/Document.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace filament_core::view {

inline constexpr double kKeySeconds = 2;         ///< between a key and the one that is added after it
inline constexpr double kLeastKeySeconds = 1e-3; ///< between two keys

/// What the panel remembers of the path that it shows.
struct PathState {
    size_t path = 0;             ///< of Document::paths
    std::optional<size_t> key{}; ///< that is selected
    double seconds = 0;          ///< [0, durationOf(path)]
    bool isPlaying = false;
    friend bool operator==(PathState const&, PathState const&) = default;
};

/// What frames of a path are recorded to.
enum class FrameKind : uint8_t { Png, Exr, Video };

/// Requests of the panel.
struct RecordingSettings {
    FrameKind kind = FrameKind::Png;
    int framesPerSecond = 30; ///< [1, 240]
};

/// What the panel shows while that is drawn.
struct RecordingProgress {
    bool isRunning = false;
    uint32_t done = 0, total = 0; ///< frames; a total of 0: still loading
    friend bool operator==(RecordingProgress const&, RecordingProgress const&) = default;
};

/// The path that is shown; a new one if the document has none. Valid until the list changes.
CameraPath& shownPath(Document& document, PathState& state);
void addPath(Document& document, PathState& state);
/// Does nothing without paths.
void removePath(Document& document, PathState& state);

/// After the selected key, half-way to the next one; at the end kKeySeconds after the last one, also without a
/// selection. Selects it.
void addKey(CameraPath& path, PathState& state, Camera const& camera);
/// Gives the selected key another camera.
void replaceKey(CameraPath& path, PathState const& state, Camera const& camera);
void removeKey(CameraPath& path, PathState& state, size_t key);
/// Changes place with the key before it (-1) or after it (1): the cameras move, the times stay.
void moveKey(CameraPath& path, PathState& state, size_t key, int places);
/// As near as its neighbours allow; the keys after it stay. Finite seconds.
void retimeKey(CameraPath& path, size_t key, double seconds);

/// The document's camera becomes that of the path at this time, which is clamped to it, and playing ends.
void scrubPath(Document& document, PathState& state, double seconds);
void selectKey(Document& document, PathState& state, size_t key); ///< and looks through it
void togglePathPlaying(Document& document, PathState& state);     ///< from the start if it is at its end
/// Time advances, if it plays: an open path stops at its end, a closed one loops. False: nothing moves.
bool playPath(Document& document, PathState& state, double elapsedSeconds);

} // namespace filament_core::view

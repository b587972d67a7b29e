// SPDX-License-Identifier: Apache-2.0
/// CameraModel: exposure by one number, bookmarks, and the cameras of a file, for the camera panel.
///   Thread  any; values.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Camera.h>
#include <filament_core/ModelCopy.h>

#include <cstddef>
#include <string>
#include <vector>

namespace filament_core::view {

/// The same aperture and ISO; the shutter gives the exposure value: t = N^2 / S * 100 / 2^EV100 (Exposure::ev100()).
Exposure withEv100(Exposure const& exposure, float ev100);

/// One that is not taken: "view 3".
void addBookmark(Document& document);
void goToBookmark(Document& document, size_t bookmark); ///< place, lens and exposure
void removeBookmark(Document& document, size_t bookmark);
/// Place and lens of a camera of the file, with the exposure that the view has.
void useCamera(Document& document, CopyCamera const& camera);

/// Where the camera looks, in degrees: 0 is -z, positive to the right (towards +x); and how far upwards.
struct CameraHeading {
    double yawDegrees = 0, pitchDegrees = 0;
};
CameraHeading headingOf(Camera const& camera);

} // namespace filament_core::view

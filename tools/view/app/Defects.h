// SPDX-License-Identifier: Apache-2.0
/// Defects: the mutations of the conformance suite (toolkit/mutations/Mutations.h), for the viewer to inject into the
/// engine that its picture is compared with.
///   Thread  any.
#pragma once

#include "tools/view/panels/Panels.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

/// Those that fit an engine of the backend, without the suite's controls, which no picture shows.
std::vector<OfferedDefect> defectsFor(Backend backend);
/// For EngineDebug::capture of one engine. Null for an unknown name and for "".
std::shared_ptr<backend::FrameCapture> injected(std::string_view defect);
/// "roughness + 1 %"; the name itself if it is not known.
std::string whatOf(std::string_view defect);

} // namespace filament_core::view

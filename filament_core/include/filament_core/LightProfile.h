// SPDX-License-Identifier: Apache-2.0
/// loadLightProfile: a photometric file of a luminaire, .ies (ANSI/IES LM-63), for PointLight::profile.
///   Memory  of the engine: at most 102 KiB a profile. On the device: that of the profiles in view, once a frame.
///   Errors  NotFound, Unreadable, Corrupt, Unsupported: one line with file, line and reason.
///   Thread  the app thread.
#pragma once

#include <filament_core/Engine.h>

#include <filesystem>

namespace filament_core {

/// Destroy it with Engine::destroy(), or let Owned<LightProfile> do it.
Result<LightProfile> loadLightProfile(Engine& engine, std::filesystem::path const& path);

} // namespace filament_core

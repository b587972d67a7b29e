// SPDX-License-Identifier: Apache-2.0
/// checkSpirv: whether a driver may see the SPIR-V of a package. Drivers trust modules; a changed word can crash them.
///   In      a package that was read from bytes, whose checksum anybody can make right.
///   Rules   every module of every variant is valid for Vulkan 1.1 (SPIRV-Tools); its resources are in the layout of
///           its program; its `main` is of the stage that it stands for; no type is larger than 1 MiB.
///   Trust   packages that are part of this program (shader::isEnginePackage()) need no check.
///   Thread  any; pure.
///   Fails   Corrupt: the variant, the stage and the message of SPIRV-Tools.
///   Cost    4 ms for each stage, once, when a material is created; variants share stages.
#pragma once

#include "base/Result.h"
#include "shaders/package/Package.h"

namespace filament_core::engine {

Result<void> checkSpirv(shader::MaterialPackage const& package);

} // namespace filament_core::engine

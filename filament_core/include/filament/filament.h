// SPDX-License-Identifier: Apache-2.0
/// The whole public API. Start at Engine.h; samples/hello is the shortest complete program.
#pragma once

#include <filament/Animator.h>
#include <filament/Backend.h>
#include <filament/Box.h>
#include <filament/Camera.h>
#include <filament/Color.h>
#include <filament/ColorGrading.h>
#include <filament/DebugDraw.h>
#include <filament/Effects.h>
#include <filament/Engine.h>
#include <filament/Environment.h>
#include <filament/Gltf.h>
#include <filament/Image.h>
#include <filament/Light.h>
#include <filament/LightProfile.h>
#include <filament/Lines.h>
#include <filament/LoadTicket.h>
#include <filament/Look.h>
#include <filament/Material.h>
#include <filament/Math.h>
#include <filament/Node.h>
#include <filament/Objects.h>
#include <filament/Photometry.h>
#include <filament/Quality.h>
#include <filament/QualityBudget.h>
#include <filament/QualityCosts.h>
#include <filament/RenderPreset.h>
#include <filament/Renderer.h>
#include <filament/ResolutionController.h>
#include <filament/Result.h>
#include <filament/Scene.h>
#include <filament/Stencil.h>
#include <filament/Units.h>
#include <filament/Version.h>
#include <filament/View.h>

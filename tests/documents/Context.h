// SPDX-License-Identifier: Apache-2.0
// What the C++ examples of the documents assume to be there: each is compiled as the body of a function in which these
// names are known (check_code.py). An example may redeclare any of them.
#pragma once

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/filament_core.h>

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace materials {
std::span<const std::byte> stone(); // as filament_add_materials() generates it
std::span<const std::byte> edges();
} // namespace materials

namespace example {
using namespace filament_core;

// Engine and Model are results at first: examples write engine-> right after Engine::create(), and engine. elsewhere.
struct Device {
    Engine& object;
    operator Engine&() const { return object; }
    Engine* operator->() const { return &object; }
    Engine& operator*() const { return object; }
};

int report(Error const& error);
std::vector<std::byte> readFile(std::filesystem::path const& path);
void showLoadingScreen();
void select(Node node, double3 const& positionWorld);

// windows
struct Window;
void* glfwGetX11Display();
unsigned long glfwGetX11Window(Window* window);
extern Window* window;
extern uint2 size, newSize;
extern bool isOpen, isResized, isEditing;

// objects
extern Renderer renderer, mapRenderer, interfaceRenderer, cameraRenderer;
extern Scene scene, world, widgets, overlay;
extern View view, overlayView, filmed;
extern Camera fromAbove, parallel;
extern SwapChain swapChain;
extern Texture dirt;
extern Material material;
extern MaterialInstance red, doorway, otherWorld, television, glow;
extern VertexBuffer vertices;
extern IndexBuffer indices;
extern Renderable smoke;
extern Result<Model> model, gizmoModel;
extern Node root;
extern std::optional<PickHit> hit;
extern Box bounds;
extern double4x4 roll, worldFromCar;
extern double frameSeconds, milliseconds, mouseX, mouseY;
extern float measured;
} // namespace example

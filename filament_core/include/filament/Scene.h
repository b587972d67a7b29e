// SPDX-License-Identifier: Apache-2.0
/// Scene: what exists. Renderables, lights and one environment; drawn by any Renderer of the same engine.
///   Thread  the app thread. Read-only while Renderer::render runs (it returns when the scene has been read).
///   Memory  arrays by column; adding and removing is O(1).
///   Life    the scene does not own buffers, materials or models: they must outlive it or be removed first.
#pragma once

#include <filament/Box.h>
#include <filament/Engine.h>
#include <filament/Light.h>

#include <memory>
#include <string>

namespace filament {

class Model;
class Environment;

struct RenderableDesc {
    VertexBuffer vertices{};
    IndexBuffer indices{};
    MaterialInstance material{};
    PrimitiveType primitive = PrimitiveType::Triangles;
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;               ///< 0: all
    float3 boundsMin{ 0 }, boundsMax{ 0 }; ///< of the positions, in object space
    double4x4 worldFromObject{ 1.0 };      ///< affine
    bool culled = true;                    ///< false: drawn even when its box is out of view
    std::string name{};
};

struct EnvironmentSettings {
    Lux illuminance{ 30'000 }; ///< what one unit of the environment's radiance is multiplied by
    float rotationRadians = 0; ///< around +Y
    bool skybox = true;        ///< draw it as background
};

class Scene {
public:
    explicit Scene(Engine& engine);
    Scene(Scene&&) noexcept;
    ~Scene();

    Renderable add(RenderableDesc const& desc);
    Light add(SunLight const& light);
    Light add(PointLight const& light);
    Light add(SpotLight const& light);
    /// Every renderable and light of the model, placed by `worldFromModel`.
    void add(Model const& model, double4x4 const& worldFromModel = double4x4(1.0));
    void remove(Renderable renderable);
    void remove(Light light);
    void setTransform(Renderable renderable, double4x4 const& worldFromObject);

    void setEnvironment(Environment const& environment, EnvironmentSettings const& settings = {});
    void setIndirectLight(IndirectLight light, Lux illuminance, float rotationRadians = 0); ///< {}: none
    void setSkybox(Skybox skybox, Lux illuminance, float rotationRadians = 0);              ///< {}: none

    Box bounds() const; ///< of all renderables
    uint32_t renderableCount() const;
    uint32_t lightCount() const;

    struct Impl;
    Impl& impl() { return *mImpl; }
    Impl const& impl() const { return *mImpl; }

private:
    std::unique_ptr<Impl> mImpl;
};

} // namespace filament

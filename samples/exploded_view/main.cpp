// SPDX-License-Identifier: Apache-2.0
// exploded_view MODEL.gltf [vulkan|gles] [OUT.png]: moves the parts of a model apart, and draws it whole, half way and
// apart, with the boxes of its parts.
#include <filament_core/filament_core.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "exploded_view: error: %s\n", error.message.c_str());
    return 1;
}

/// Each node moves away from the middle of what its parent carries, along the line to the middle of what it carries
/// itself. Children go with their parents: assemblies part first, and their parts within them.
class ExplodedView {
public:
    ExplodedView(Scene& scene, ModelCopy const& copy, Node root) : mScene(scene) {
        for (CopyRenderable const& part : copy.renderables())
            for (Node node = part.node; node; node = scene.parent(node))
                mBoxes[node].add(scene.bounds(part.renderable));
        addChildren(root);
    }

    /// 0: whole; 1: the distance of each part from the middle of its assembly doubles.
    void set(double factor) {
        for (Part const& part : mParts) {
            double4x4 moved = part.rest;
            moved[3] += double4(part.direction * factor, 0);
            mScene.setTransform(part.node, moved);
        }
    }

private:
    struct Part {
        Node node;
        double4x4 rest;
        double3 direction; ///< in the space of the parent
    };

    void addChildren(Node parent) {
        const double3 middle = mBoxes[parent].center();
        const glm::dmat3 parentFromWorld = glm::inverse(glm::dmat3(mScene.worldFromNode(parent)));
        for (Node child = mScene.firstChild(parent); child; child = mScene.nextSibling(child)) {
            const auto found = mBoxes.find(child);
            if (found == mBoxes.end()) continue; // carries nothing
            mParts.push_back(
                    { child, mScene.parentFromNode(child), parentFromWorld * (found->second.center() - middle) });
            addChildren(child);
        }
    }

    Scene& mScene;
    std::unordered_map<Node, Box> mBoxes; ///< of what nodes carry, in the world
    std::vector<Part> mParts;
};

/// Looks at the whole box from the front, the right and above, from where its corners just fit.
Camera fitted(Box const& box, double aspect) {
    constexpr double kFovDegrees = 30, kMargin = 1.05;
    const double3 towards = glm::normalize(double3(0.6, 0.35, 1)), right = glm::normalize(double3(1, 0, -0.6)),
                  up = glm::cross(towards, right);
    const double tangent = std::tan(glm::radians(0.5 * kFovDegrees)) / kMargin;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const double3 at = double3(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                   corner & 4 ? box.max.z : box.min.z) -
                           box.center();
        const double reach = std::max(std::abs(glm::dot(at, right)) / aspect, std::abs(glm::dot(at, up)));
        distance = std::max(distance, glm::dot(at, towards) + reach / tangent);
    }
    return Camera::lookAt(box.center() + towards * distance, box.center(),
                          { .verticalFovDegrees = static_cast<float>(kFovDegrees) });
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return fail({ ErrorCode::InvalidArgument, "usage: exploded_view MODEL.gltf [vulkan|gles] [OUT.png]" });
    const bool isVulkan = argc > 2 && std::string_view(argv[2]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    const Result<Model> model = loadGltf(*engine, argv[1]);
    if (!model) return fail(model.error());
    Scene scene(*engine);
    const Node root = scene.add(*model, fitToUnitCube(model->bounds()));
    const Result<ModelCopy> copy = ModelCopy::of(scene, root);
    if (!copy) return fail(copy.error());
    scene.add(SunLight{ .directionWorld = { -1, -1.2f, -0.9f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.3f, -0.6f }, .illuminance = Lux{ 30'000 }, .castsShadows = false });

    ExplodedView exploded(scene, *copy, root);
    constexpr uint2 kSize{ 160, 180 };
    exploded.set(1);
    View view{ .camera = fitted(scene.bounds(), double{ kSize.x } / kSize.y),
               .size = kSize,
               .clearColor = { 0.25f, 0.27f, 0.3f, 1 },
               .samples = 4 };
    Renderer renderer(*engine);
    constexpr std::array kFactors{ 0.0, 0.5, 1.0 };
    Image strip{ .width = kSize.x * 3, .height = kSize.y };
    for (size_t i = 0; i < kFactors.size(); ++i) {
        exploded.set(kFactors[i]);
        DebugDraw boxes;
        for (CopyRenderable const& part : copy->renderables())
            boxes.box(scene.bounds(part.renderable), { .color = { 1, 0.7f, 0.1f, 0.6f } });
        view.debugDraw = kFactors[i] > 0 ? &boxes : nullptr;
        const Result<Image> image = renderer.renderToImage(scene, view);
        if (!image) return fail(image.error());
        strip.format = image->format;
        strip.pixels.resize(image->pixels.size() * kFactors.size());
        const size_t row = size_t{ kSize.x } * 4;
        for (size_t y = 0; y < kSize.y; ++y)
            std::memcpy(strip.pixels.data() + (y * kFactors.size() + i) * row, image->pixels.data() + y * row, row);
    }
    const Result<void> saved = savePng(argc > 3 ? argv[3] : "exploded_view.png", strip);
    return saved ? 0 : fail(saved.error());
}

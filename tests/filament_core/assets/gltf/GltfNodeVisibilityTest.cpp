// SPDX-License-Identifier: Apache-2.0
// KHR_node_visibility hides the meshes and lights of a node, with all that is below it.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

using namespace test;

TEST(GltfNodeVisibility, HidesTheLightsOfANodeAndOfAllBelow) {
    TestFile file;
    file.root = Json::parse(R"({ "asset": { "version": "2.0" }, "extensionsUsed": [ "KHR_node_visibility" ],
        "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point" } ] } },
        "scenes": [ { "nodes": [ 0 ] } ], "nodes": [
            { "children": [ 1, 2 ], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "children": [ 3 ], "extensions": { "KHR_node_visibility": { "visible": false },
                                                 "KHR_lights_punctual": { "light": 0 } } },
            { "extensions": { "KHR_node_visibility": { "visible": true }, "KHR_lights_punctual": { "light": 0 } } },
            { "extensions": { "KHR_node_visibility": { "visible": true }, "KHR_lights_punctual": { "light": 0 } } } ] })");
    const ModelData model = loaded(file);
    EXPECT_TRUE(model.warnings.empty());
    ASSERT_EQ(model.nodes.size(), 4u) << "animations and joints still find all nodes";
    EXPECT_EQ(std::ranges::count(model.nodes, 0u, &NodeData::light), 2);
    EXPECT_EQ(model.nodes[0].light, 0u);
}

TEST(GltfNodeVisibility, AHiddenMeshIsNotThereAndCastsNothing) {
    TestFile file = TestFile::triangle();
    EXPECT_EQ(loaded(file).meshes.size(), 1u);
    file.root["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    const ModelData model = loaded(file);
    EXPECT_TRUE(model.meshes.empty());
    ASSERT_EQ(model.nodes.size(), 1u);
    EXPECT_EQ(model.nodes[0].mesh, kNone);
}

} // namespace
} // namespace filament_core::assets

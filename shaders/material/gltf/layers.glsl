// SPDX-License-Identifier: Apache-2.0
// The layers of the KHR_materials extensions on top of gltfSurface(). Unused layers are neutral: constants that the
// driver knows when it creates the pipeline, so it removes the layer.

// width: of its normal.
void gltfClearCoat(inout MaterialInputs material, float width) {
    material.clearCoat = 0.0;
    if (materialConstants_hasClearCoat) {
        vec4 maps = vec4(1.0); // red: coat, green: its roughness
        if (materialConstants_hasClearCoatMap || materialConstants_hasClearCoatRoughnessMap) {
            maps = texture(materialParams_clearCoatMap, mapUv(materialConstants_clearCoatUv,
                    materialConstants_clearCoatTransform, materialParams.clearCoatUvMatrix));
        }
        if (materialConstants_clearCoatRoughnessApart) {
            maps.g = texture(materialParams_clearCoatRoughnessMap, mapUv(materialConstants_clearCoatRoughnessUv,
                    materialConstants_clearCoatRoughnessTransform, materialParams.clearCoatRoughnessUvMatrix)).g;
        }
        material.clearCoat = (materialConstants_hasClearCoatMap ? maps.r : 1.0) * materialParams.clearCoat;
        material.clearCoatRoughness =
                (materialConstants_hasClearCoatRoughnessMap ? maps.g : 1.0) * materialParams.clearCoatRoughness;
        if (materialConstants_clearCoatNormalWidth)
            material.clearCoatRoughness = widenedPerceptualRoughness(material.clearCoatRoughness, width);
    }
}

// As gltfNormal().
vec4 gltfClearCoatNormal() {
    vec2 uv = mapUv(materialConstants_clearCoatNormalUv, materialConstants_clearCoatNormalTransform,
            materialParams.clearCoatNormalUvMatrix);
    vec4 texel = texture(materialParams_clearCoatNormalMap, uv);
    vec3 n = texel.xyz * 2.0 - 1.0;
    n.xy = vectorOfVertex(n.xy, materialConstants_clearCoatNormalFrame, uv, materialParams.clearCoatNormalUvMatrix);
    return vec4(n.xy * materialParams.clearCoatNormalScale, n.z,
            materialConstants_clearCoatNormalWidth ? texel.a * materialParams.clearCoatNormalScale : 0.0);
}

void gltfSheen(inout MaterialInputs material) {
    if (materialConstants_hasSheen) {
        vec4 maps = vec4(1.0); // RGB: colour, alpha: roughness
        if (materialConstants_hasSheenColorMap || materialConstants_hasSheenRoughnessMap) {
            maps = texture(materialParams_sheenMap, mapUv(materialConstants_sheenUv, materialConstants_sheenTransform,
                    materialParams.sheenUvMatrix));
        }
        if (materialConstants_sheenRoughnessApart) {
            maps.a = texture(materialParams_sheenRoughnessMap, mapUv(materialConstants_sheenRoughnessUv,
                    materialConstants_sheenRoughnessTransform, materialParams.sheenRoughnessUvMatrix)).a;
        }
        material.sheenColor = (materialConstants_hasSheenColorMap ? maps.rgb : vec3(1.0)) * materialParams.sheenColor;
        material.sheenRoughness = (materialConstants_hasSheenRoughnessMap ? maps.a : 1.0) * materialParams.sheenRoughness;
    }
}

void gltfSpecular(inout MaterialInputs material) {
    if (materialConstants_hasIor) material.ior = materialParams.ior;
    if (materialConstants_hasSpecular) {
        vec4 maps = vec4(1.0); // RGB: colour, alpha: factor
        if (materialConstants_hasSpecularColorMap || materialConstants_hasSpecularFactorMap) {
            maps = texture(materialParams_specularMap, mapUv(materialConstants_specularUv,
                    materialConstants_specularTransform, materialParams.specularUvMatrix));
        }
        if (materialConstants_specularFactorApart) {
            maps.a = texture(materialParams_specularFactorMap, mapUv(materialConstants_specularFactorUv,
                    materialConstants_specularFactorTransform, materialParams.specularFactorUvMatrix)).a;
        }
        material.specularColorFactor =
                (materialConstants_hasSpecularColorMap ? maps.rgb : vec3(1.0)) * materialParams.specularColorFactor;
        material.specularFactor = (materialConstants_hasSpecularFactorMap ? maps.a : 1.0) * materialParams.specularFactor;
    }
}

// KHR_materials_anisotropy makes the direction along the tangent rougher, alpha t = mix(alpha, 1, strength^2), and does
// not change the other. The guide's anisotropy a stretches one and narrows the other: alpha (1 + a), alpha (1 - a).
// Both give the same two roughnesses if alpha is set to their mean and a to their difference over their sum.
void gltfAnisotropy(inout MaterialInputs material) {
    if (materialConstants_hasAnisotropy) {
        vec2 turn = materialParams.anisotropyRotation;
        vec2 direction = turn;
        float amount = 1.0;
        if (materialConstants_hasAnisotropyMap) {
            vec2 uv = mapUv(materialConstants_anisotropyUv, materialConstants_anisotropyTransform,
                    materialParams.anisotropyUvMatrix);
            vec3 map = texture(materialParams_anisotropyMap, uv).xyz;
            vec2 authored = map.xy * 2.0 - 1.0;
            direction = vec2(authored.x * turn.x - authored.y * turn.y, authored.x * turn.y + authored.y * turn.x);
            direction = vectorOfVertex(direction, materialConstants_anisotropyFrame, uv, materialParams.anisotropyUvMatrix);
            amount = map.z;
        }
        float strength = amount * materialParams.anisotropyStrength;
        float across = material.roughness * material.roughness;
        float along = mix(across, 1.0, strength * strength);
        float sum = along + across;
        material.anisotropy = strength > 0.0 ? (along - across) / sum : 0.0;
        material.anisotropyDirection = vec3(direction, 0.0);
        material.roughness = strength > 0.0 ? sqrt(0.5 * sum) : material.roughness;
    }
}

void gltfIridescence(inout MaterialInputs material) {
    if (materialConstants_hasIridescence) {
        vec4 maps = vec4(1.0); // red: factor, green: from the minimum to the maximum
        if (materialConstants_hasIridescenceMap || materialConstants_hasIridescenceThicknessMap) {
            maps = texture(materialParams_iridescenceMap, mapUv(materialConstants_iridescenceUv,
                    materialConstants_iridescenceTransform, materialParams.iridescenceUvMatrix));
        }
        if (materialConstants_iridescenceThicknessApart) {
            maps.g = texture(materialParams_iridescenceThicknessMap, mapUv(materialConstants_iridescenceThicknessUv,
                    materialConstants_iridescenceThicknessTransform, materialParams.iridescenceThicknessUvMatrix)).g;
        }
        vec2 range = materialParams.iridescenceThickness;
        material.iridescence = (materialConstants_hasIridescenceMap ? maps.r : 1.0) * materialParams.iridescence;
        material.iridescenceIor = materialParams.iridescenceIor;
        material.iridescenceThickness =
                materialConstants_hasIridescenceThicknessMap ? mix(range.x, range.y, maps.g) : range.y;
    }
}

vec4 gltfDiffuseTransmissionMaps() {
    vec4 maps = vec4(1.0); // RGB: colour, alpha: factor
    if (materialConstants_hasDiffuseTransmissionColorMap || materialConstants_hasDiffuseTransmissionMap) {
        vec4 texel = texture(materialParams_diffuseTransmissionMap, mapUv(materialConstants_diffuseTransmissionUv,
                materialConstants_diffuseTransmissionTransform, materialParams.diffuseTransmissionUvMatrix));
        if (materialConstants_hasDiffuseTransmissionColorMap) maps.rgb = texel.rgb;
        if (materialConstants_hasDiffuseTransmissionMap) maps.a = texel.a;
    }
    if (materialConstants_diffuseTransmissionFactorApart) {
        maps.a = texture(materialParams_diffuseTransmissionFactorMap, mapUv(materialConstants_diffuseTransmissionFactorUv,
                materialConstants_diffuseTransmissionFactorTransform,
                materialParams.diffuseTransmissionFactorUvMatrix)).a;
    }
    return maps;
}

void gltfDiffuseTransmission(inout MaterialInputs material) {
    if (materialConstants_hasDiffuseTransmission) {
        vec4 maps = gltfDiffuseTransmissionMaps();
        material.diffuseTransmissionColor = maps.rgb * materialParams.diffuseTransmissionColor;
        material.diffuseTransmission = maps.a * materialParams.diffuseTransmission;
    }
}

// Sets the normals. Returns the widths of the surface's and of the coat's.
vec2 gltfNormals(inout MaterialInputs material) {
    vec2 widths = vec2(gltfSurfaceNormal(material), 0.0);
    if (materialConstants_hasClearCoatNormalMap) {
        vec4 coat = gltfClearCoatNormal();
        material.clearCoatNormal = coat.xyz;
        widths.y = coat.w;
    }
    return widths;
}

// coatWidth: of the coat's normal.
void gltfLayers(inout MaterialInputs material, float coatWidth) {
    gltfClearCoat(material, coatWidth);
    gltfSheen(material);
    gltfSpecular(material);
    gltfAnisotropy(material);
    gltfIridescence(material);
    gltfDiffuseTransmission(material);
}

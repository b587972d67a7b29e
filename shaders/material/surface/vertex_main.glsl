// SPDX-License-Identifier: Apache-2.0
// Vertex stage of surface materials, entry point: attributes -> materialVertex() -> varyings.

void main() {
    MaterialVertexInputs inputs;
    MATERIAL_CLEAR_VARIABLES(inputs)
#if defined(VARIANT_SKINNING)
    deformPosition(mesh_position);
#endif
#if defined(HAS_COLOR)
    inputs.color = mesh_color;
#endif
#if defined(HAS_UV0)
    inputs.uv0 = meshUv(mesh_uv0);
#endif
#if defined(HAS_UV1)
    inputs.uv1 = meshUv(mesh_uv1);
#endif
#if defined(NEEDS_NORMAL)
    vec3 normal, tangent, bitangent;
    tangentFrame(mesh_tangents, normal, tangent, bitangent);
#if defined(VARIANT_SKINNING)
    float deformationSign = deformFrame(normal, tangent);
#endif
    inputs.worldNormal = normalizeOrZero(normalToWorld(normal));
#endif
#if defined(HAS_CLIP_SPACE_TRANSFORM)
    inputs.clipSpaceTransform = mat4(1.0);
#endif
    inputs.worldPosition = worldPositionOfVertex();

#if defined(HAS_MATERIAL_VERTEX)
    materialVertex(inputs);
#endif

#if defined(NEEDS_WORLD_POSITION)
    vertex_worldPosition = inputs.worldPosition.xyz;
#endif
#if defined(NEEDS_NORMAL)
    vertex_worldNormal = inputs.worldNormal;
#endif
#if defined(NEEDS_TANGENT)
    vertex_worldTangent = vec4(normalizeOrZero(directionToWorld(tangent)),
            mesh_tangents.w < 0.0 ? -bitangentSign() : bitangentSign());
#if defined(VARIANT_SKINNING)
    vertex_worldTangent.w *= deformationSign;
#endif
#endif
#if defined(HAS_COLOR)
    vertex_color = inputs.color;
#endif
#if defined(HAS_UV0) && defined(HAS_UV1)
    vertex_uv01 = vec4(inputs.uv0, inputs.uv1);
#elif defined(HAS_UV0)
    vertex_uv01 = vec4(inputs.uv0, 0.0, 0.0);
#elif defined(HAS_UV1)
    vertex_uv01 = vec4(0.0, 0.0, inputs.uv1);
#endif
#if defined(NEEDS_INSTANCE_INDEX)
    vertex_instanceIndex = getInstanceIndex();
#endif
    MATERIAL_WRITE_VARIABLES(inputs)
    MATERIAL_WRITE_CUSTOMS

#if defined(HAS_CLIP_SPACE_TRANSFORM)
    gl_Position = inputs.clipSpaceTransform * getPosition();
#elif defined(VERTEX_DOMAIN_DEVICE)
    gl_Position = getPosition();
#else
    gl_Position = frameUniforms.clipFromWorld * vec4(inputs.worldPosition.xyz, 1.0);
#endif
    gl_PointSize = 1.0; // both APIs leave the size of points undefined otherwise
}

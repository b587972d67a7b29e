// SPDX-License-Identifier: Apache-2.0
// Vertex stage of surface materials, entry point: attributes -> materialVertex() -> varyings.

#if defined(WIDE_LINES)
const float kMaxLineWidth = 1024.0; // pixels

float inFrontOfNearPlane(vec4 clip) { return frameUniforms.exposure.w > 0.0 ? clip.z : clip.w - clip.z; }

// A corner behind the camera would turn the rectangle inside out: such an end moves to the near plane.
vec4 inFront(vec4 clip, vec4 end) {
    float here = inFrontOfNearPlane(clip), there = inFrontOfNearPlane(end);
    return here < 0.0 && there > 0.0 ? mix(clip, end, here / (here - there)) : clip;
}

// Moves one end of a segment sideways by half the width: a rectangle with the ends cut off squarely, as the
// rectangular lines of Vulkan's VK_EXT_line_rasterization. In homogeneous coordinates the direction is the same
// wherever the other end is, and the width is the same all along.
vec4 widened(vec4 clip, vec4 end, float side, float width) {
    vec2 pixels = passUniforms.target.xy;
    vec2 along = ((end.xy - clip.xy) * clip.w - clip.xy * (end.w - clip.w)) * pixels;
    float largest = max(abs(along.x), abs(along.y));
    vec3 direction = normalizeOrZero(largest > 0.0 ? vec3(along / largest, 0.0) : vec3(0.0));
    float halfWidth = width > 0.0 ? min(width, kMaxLineWidth) : 0.0; // NaN: nothing
    clip.xy += vec2(-direction.y, direction.x) * (side * halfWidth * clip.w) / pixels; // the picture is 2 wide
    return clip;
}
#endif

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
#if defined(WIDE_LINES)
    inputs.lineWidth = 1.0;
    inputs.lineEnd = worldPositionOf(vec4(mesh_custom0.xyz, 1.0));
#endif

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
#if defined(WIDE_LINES)
    vec4 lineEnd = frameUniforms.clipFromWorld * vec4(inputs.lineEnd.xyz, 1.0);
    gl_Position = widened(inFront(gl_Position, lineEnd), lineEnd, mesh_custom0.w, inputs.lineWidth);
#endif
    gl_PointSize = 1.0; // both APIs leave the size of points undefined otherwise
}

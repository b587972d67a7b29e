// SPDX-License-Identifier: Apache-2.0
// Fog on the colour of a fragment, by its blending. quality_fog is a set of shader::FogTerms.

const int kFogFromEnvironment = 2;
const int kFogFromRgbm = 4;
const int kFogSun = 8;

// Lit materials have their position. Others need it only here, and derive it from the depth, or from its
// inverse as it was before the projection, which is as exact with any depth range.
FogRay fogRayOfFragment() {
#if defined(FOG_POINT_IS_KNOWN)
    highp vec4 point = vec4(vertex_worldPosition, 1.0);
#else
    highp vec4 point = fogPointAt(gl_FragCoord.xy, gl_FragCoord.z);
#if !defined(VERTEX_DOMAIN_DEVICE)
    point.w = gl_FragCoord.w;
#endif
#endif
    return fogRayTo(point);
}

// Of what is all fog.
highp vec3 fogRadiance(highp vec3 direction) {
    highp vec3 light = frameUniforms.fogLight.rgb;
    if ((quality_fog & kFogFromEnvironment) != 0) {
        highp vec3 inEnvironment = direction * mat3(frameUniforms.worldFromEnvironment);
        highp vec4 texel = textureLod(passFog, inEnvironment, frameUniforms.ambient.y);
        if ((quality_fog & kFogFromRgbm) != 0) {
            light *= radianceFromRgbm(texel);
        } else {
            light *= texel.rgb;
        }
    }
    return light;
}

// The light of the fog between camera and fragment; w: its opacity.
highp vec4 fogOfFragment() {
    FogRay ray = fogRayOfFragment();
    highp float opacity = fogAlong(ray, frameUniforms.fogMedium.z);
    highp vec3 light = fogRadiance(ray.direction) * opacity;
    if ((quality_fog & kFogSun) != 0) {
        highp vec4 sun = frameUniforms.fogSunDirection;
        highp float glow = fogGlow(dot(ray.direction, sun.xyz), frameUniforms.fogSun.w);
        light += frameUniforms.fogSun.rgb * (glow * fogAlong(ray, sun.w));
    }
    return vec4(light, opacity);
}

// FOG_COVERS: alpha is how much of the pixel the surface covers, and the colour contains it. FOG_ADDS: the surface adds
// to what is behind, which has fog of its own. FOG_FILTERS: it multiplies what is behind, and fog in front hides the
// filter. seen: scene colour behind, in the colour, which has its fog already; share: how much of the surface
// shows it.
void applyFog(inout highp vec4 color, highp vec3 seen, highp vec3 share) {
    highp vec4 fog = fogOfFragment();
    highp float left = 1.0 - fog.w;
#if defined(FOG_FILTERS)
    color = color * left + fog.w;
#elif defined(FOG_ADDS)
    color.rgb *= left;
#elif defined(FOG_COVERS)
    color.rgb = (color.rgb - seen) * left + fog.rgb * (vec3(1.0) - share) * color.a + seen;
#else
    color.rgb = (color.rgb - seen) * left + fog.rgb * (vec3(1.0) - share) + seen;
#endif
}

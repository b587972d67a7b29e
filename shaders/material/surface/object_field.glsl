// SPDX-License-Identifier: Apache-2.0
// The diffuse light of an irradiance grid (docs/irradiance-grids.md) over the box of an object, where
// quality_diffuseIrradiance is kIrradianceOfField: shader::IrradianceField. The draw binds it behind the object's record, so
// that all indices are constant: uniform values that all pixels share cost next to nothing on CPUs.

highp vec3 fieldColor(highp vec4 red, highp vec4 green, highp vec4 blue, highp vec3 place) {
    return vec3(fieldValue(red, place), fieldValue(green, place), fieldValue(blue, place));
}

// Irradiance / pi around a direction of the world, before frameUniforms.ambient.x: irradianceSh() of three bands.
highp vec3 objectIrradiance(highp vec3 n) {
    ObjectRecord a = objectUniforms.objects[1], b = objectUniforms.objects[2], c = objectUniforms.objects[3];
    ObjectRecord d = objectUniforms.objects[4], bands = objectUniforms.objects[5];
    highp vec3 place = fieldPlace(vertex_worldPosition - a.row0.xyz, a.row1.xyz);
    highp vec3 e = fieldColor(a.row2, a.flags, b.row0, place);
    e += fieldColor(b.row1, b.row2, b.flags, place) * n.y + fieldColor(c.row0, c.row1, c.row2, place) * n.z;
    e += fieldColor(c.flags, d.row0, d.row1, place) * n.x;
    e += d.row2.xyz * (n.x * n.y) + d.flags.xyz * (n.y * n.z) + bands.row0.xyz * (3.0 * n.z * n.z - 1.0);
    e += bands.row1.xyz * (n.z * n.x) + bands.row2.xyz * (n.x * n.x - n.y * n.y);
    return max(e, vec3(0.0));
}

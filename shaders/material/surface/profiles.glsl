// SPDX-License-Identifier: Apache-2.0
// The relative intensity of a light with a profile in a direction. quality_lightProfiles is 0 in a view without such lights, and
// then none of this is in the program. LightProfileTable::shareAt() is the twin.

// Of 65535. entries: the word where those of the table begin.
highp float profileEntry(int entries, int entry) {
    uint word = froxelBuffer.words[entries + (entry >> 1)];
    return float((entry & 1) == 0 ? word & 0xFFFFu : word >> 16u);
}

// Between two rows of a column, whose first entry is `entry`.
highp float profileBetweenRows(int entries, int entry, highp float part) {
    highp float above = profileEntry(entries, entry);
    return above + (profileEntry(entries, entry + 1) - above) * part;
}

// A share of the peak. profiled: the ProfiledLight. forward: unit, the axis of the light. away: unit, from the light.
highp float profileShare(int profiled, highp vec3 forward, highp vec3 away) {
    int first = int(frameUniforms.skyFactor.w);
    int words = first + profiled * kProfiledLightWords;
    highp vec3 side = vec3(uintBitsToFloat(froxelBuffer.words[words]), uintBitsToFloat(froxelBuffer.words[words + 1]),
            uintBitsToFloat(froxelBuffer.words[words + 2]));
    int table = first + int(froxelBuffer.words[words + 3]);
    int rows = int(froxelBuffer.words[table]);
    int columns = int(froxelBuffer.words[table + 1]);
    highp float rowsPerRadian = uintBitsToFloat(froxelBuffer.words[table + 2]);
    highp vec3 direction = vec3(dot(away, side), dot(away, cross(side, forward)), dot(away, forward));
    highp vec2 at = profilePlace(direction, rowsPerRadian, float(columns));
    int row = min(int(at.x), rows - 2);
    int whole = int(at.y);
    int column = whole >= columns ? 0 : whole; // a turn of nearly 1 may round to it
    int next = column + 1 >= columns ? 0 : column + 1;
    highp float down = min(at.x - float(row), 1.0);
    int entries = table + kProfileHeaderWords;
    highp float left = profileBetweenRows(entries, column * rows + row, down);
    highp float right = profileBetweenRows(entries, next * rows + row, down);
    highp float share = (left + (right - left) * (at.y - float(whole))) * (1.0 / 65535.0);
    return at.x > float(rows - 1) + 1e-3 ? 0.0 : share;
}

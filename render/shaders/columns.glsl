// Workgroups of 8 x 8 pixels, an invocation each, or, where a device works through a group's invocations a subgroup at a
// time, a column each: what is the same for all pixels is then fetched and kept for eight.
layout(local_size_x = 8, local_size_y = 8, local_size_y_id = 11) in;
const int kColumn = 8 / int(gl_WorkGroupSize.y);

ivec2 pixel_of_column(uvec2 group, int row) {
  return ivec2(8u * group) + ivec2(gl_LocalInvocationID.x, int(gl_LocalInvocationID.y) * kColumn + row);
}

// The BVH's structure, and the shader's traversal of it against Embree.
#include "render/scene/bvh.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "render/scene/bvh_collapse.hpp"
#include "render/scene/ray_query.hpp"
#include "tests/support/scene_oracle.hpp"
#include "tracking/input_error.hpp"

namespace {

using render::Bvh4;
using render::Scene;
using scene_oracle::trace;

constexpr std::uint32_t kSeed = 20240611;

struct Ray {
  glm::vec3 origin, direction;
};

struct Bounds {
  glm::vec3 low{1e30F}, high{-1e30F};
};

Bounds bounds_of(const Scene& scene) {
  Bounds b;
  for (const auto& vertex : scene.vertices) {
    b.low = glm::min(b.low, vertex.position);
    b.high = glm::max(b.high, vertex.position);
  }
  return b;
}

// Random rays: origins in and around the scene, directions everywhere.
std::vector<Ray> random_rays(const Scene& scene, std::size_t count) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-0.2F, 1.2F);
  std::normal_distribution<float> normal;
  const Bounds b = bounds_of(scene);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const glm::vec3 origin = glm::mix(b.low - 1.0F, b.high + 1.0F, glm::vec3(unit(random), unit(random), unit(random)));
    rays.push_back({origin, glm::normalize(glm::vec3(normal(random), normal(random), normal(random)))});
  }
  return rays;
}

// One or two zero components, of either sign.
std::vector<Ray> axis_parallel_rays(const Scene& scene, std::size_t count) {
  std::vector<Ray> rays = random_rays(scene, count);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    glm::vec3& d = rays[i].direction;
    const auto axis = static_cast<int>(i % 3);
    d[axis] = i % 2 == 0 ? 0.0F : -0.0F;
    if (i % 4 < 2) d[(axis + 1) % 3] = i % 2 == 0 ? -0.0F : 0.0F;
    d = glm::normalize(d);
  }
  return rays;
}

// A pinhole camera that looks at the scene's middle from outside.
std::vector<Ray> coherent_rays(const Scene& scene, int size) {
  const Bounds b = bounds_of(scene);
  const glm::vec3 middle = 0.5F * (b.low + b.high);
  const glm::vec3 eye = middle + glm::length(b.high - b.low) * glm::vec3(0.31F, 0.47F, 0.83F);
  const glm::vec3 ahead = glm::normalize(middle - eye);
  const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0)));
  const glm::vec3 up = glm::cross(right, ahead);
  std::vector<Ray> rays;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(size) - 0.5F;
      const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(size) - 0.5F;
      rays.push_back({eye, glm::normalize(ahead + u * right + v * up)});
    }
  }
  return rays;
}

// How far inside a triangle a ray passes, as the least barycentric weight, in double precision; negative outside.
double inside(const Scene& scene, std::uint32_t triangle, const Ray& ray) {
  const glm::uvec3 index = scene.triangles[triangle];
  const glm::dvec3 v0(scene.vertices[index.x].position), d(ray.direction);
  const glm::dvec3 e1 = glm::dvec3(scene.vertices[index.y].position) - v0;
  const glm::dvec3 e2 = glm::dvec3(scene.vertices[index.z].position) - v0;
  const glm::dvec3 p = glm::cross(d, e2), s = glm::dvec3(ray.origin) - v0;
  const double determinant = glm::dot(e1, p);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(d, glm::cross(s, e1)) / determinant;
  return std::min({u, v, 1.0 - u - v});
}

// Hit by hit. Two triangles may swap where they coincide, so a different triangle passes when the distances agree; a
// float32 intersection is good to some 1e-7 of the coordinates, 1e-5 leaves room for slanting triangles. A ray through
// the very edge of the nearer triangle (within 1e-4 of a weight, once or twice in 100,000 rays) may go either way.
void expect_like_embree(const Scene& scene, const std::vector<Ray>& rays, const std::string& what) {
  SCOPED_TRACE(what + ", seed " + std::to_string(kSeed));
  const Bvh4 bvh = render::build_bvh4(scene);
  const render::RayQuery embree(scene);
  const Bounds b = bounds_of(scene);
  const float size = std::max(glm::length(b.low), glm::length(b.high));
  std::size_t hits = 0, wrong = 0, edges = 0;
  for (const Ray& ray : rays) {
    const auto ours = trace(bvh, ray.origin, ray.direction);
    const auto any = trace(bvh, ray.origin, ray.direction, 1e30F, true);
    EXPECT_EQ(ours.has_value(), any.has_value());
    const auto theirs = embree.closest(ray.origin, ray.direction);
    if (theirs) ++hits;
    bool same = ours.has_value() == theirs.has_value();
    if (ours && theirs && ours->triangle != theirs->triangle) {
      same = std::abs(static_cast<double>(ours->t) - theirs->distance) <= 1e-5 * theirs->distance + 1e-6 * size;
    }
    if (!same) {
      const bool we_are_nearer = ours && (!theirs || static_cast<double>(ours->t) < theirs->distance);
      const double weight = inside(scene, we_are_nearer ? ours->triangle : theirs->triangle, ray);
      same = std::abs(weight) < 1e-4 && ++edges <= rays.size() / 20000;
    }
    if (ours && theirs && ours->triangle == theirs->triangle) {
      EXPECT_NEAR(ours->t, theirs->distance, 1e-5 * theirs->distance + 1e-5 * size);
      EXPECT_EQ(ours->material, scene.triangle_material[ours->triangle]);
    }
    if (!same && ++wrong <= 3) {
      ADD_FAILURE() << "origin " << ray.origin.x << " " << ray.origin.y << " " << ray.origin.z << " direction "
                    << ray.direction.x << " " << ray.direction.y << " " << ray.direction.z << ": ours "
                    << (ours ? ours->t : -1.0F) << ", Embree " << (theirs ? theirs->distance : -1.0);
    }
  }
  EXPECT_EQ(wrong, 0U) << "of " << rays.size();
  EXPECT_GT(hits, rays.size() / 50) << "too few hits to say anything";
}

void expect_like_embree(const Scene& scene) {
  expect_like_embree(scene, random_rays(scene, 100000), "random");
  expect_like_embree(scene, axis_parallel_rays(scene, 50000), "axis-parallel");
  expect_like_embree(scene, coherent_rays(scene, 200), "coherent");
}

TEST(Traversal, one_triangle_like_embree) {
  Scene scene = scene_oracle::one_triangle();
  expect_like_embree(scene, coherent_rays(scene, 200), "coherent");
  expect_like_embree(scene, random_rays(scene, 100000), "random");
}

TEST(Traversal, waves_like_embree) {
  expect_like_embree(scene_oracle::waves(200));
}
TEST(Traversal, nested_boxes_like_embree) {
  expect_like_embree(scene_oracle::nested_boxes());
}
TEST(Traversal, far_soup_like_embree) {
  expect_like_embree(scene_oracle::far_soup(kSeed, 20000));
}

// Rays inside the plane of a box's face and along its edges must still see what stands in their way.
TEST(Traversal, a_ray_along_a_coplanar_face_sees_the_wall_ahead) {
  Scene scene = scene_oracle::nested_boxes();
  scene_oracle::add_quad(scene, {20, -5, -5}, {0, 0, 10}, {0, 10, 0});
  const Bvh4 bvh = render::build_bvh4(scene);
  for (const float side : {0.0F, -0.0F}) {
    const auto hit = trace(bvh, {-30, 0, 0.25F}, {1, side, side});
    ASSERT_TRUE(hit);
    EXPECT_LE(hit->t, 50.0F);
  }
  Scene wall;
  scene_oracle::add_quad(wall, {20, 0, 0}, {0, 0, 10}, {0, 10, 0});
  const Bvh4 wall_bvh = render::build_bvh4(wall);
  for (const float side : {0.0F, -0.0F}) {
    const auto hit = trace(wall_bvh, {-30, 0, 5}, {1, side, side});  // its lower edge
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->t, 50.0F);
  }
}

TEST(Traversal, a_ray_that_starts_on_a_triangle_does_not_hit_it) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::one_triangle());
  EXPECT_FALSE(trace(bvh, {0, 0, -2}, {0, 0, -1}));
  EXPECT_FALSE(trace(bvh, {0, 0, -2}, {0, 0, 1}));
  EXPECT_TRUE(trace(bvh, {0, 0, -1.999F}, {0, 0, -1}));
}

TEST(Traversal, t_max_ends_the_ray) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::one_triangle());
  const glm::vec3 o(0, 0, 0), d(0, 0, -1);
  EXPECT_TRUE(trace(bvh, o, d, 2.001F));
  EXPECT_FALSE(trace(bvh, o, d, 2.0F));
  EXPECT_FALSE(trace(bvh, o, d, 1.0F));
  EXPECT_FALSE(trace(bvh, o, d, 1.0F, true));
  EXPECT_FALSE(trace(bvh, o, d, -1.0F));
  EXPECT_TRUE(trace(bvh, o, d, std::numeric_limits<float>::infinity()));
}

TEST(Traversal, a_direction_of_any_length_scales_t) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::one_triangle());
  EXPECT_FLOAT_EQ(trace(bvh, {0, 0, 0}, {0, 0, -4})->t, 0.5F);
  EXPECT_FLOAT_EQ(trace(bvh, {0, 0, 0}, {0, 0, -0.001F})->t, 2000.0F);
}

TEST(Traversal, rays_that_are_not_finite_or_have_no_direction_hit_nothing) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::nested_boxes());
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, -nan, inf, -inf}) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 wrong(0.1F, 0.2F, 0.3F);
      wrong[axis] = bad;
      EXPECT_FALSE(trace(bvh, wrong, {0, 0, -1}));
      EXPECT_FALSE(trace(bvh, {0, 1, 0}, wrong));
    }
  }
  EXPECT_FALSE(trace(bvh, {0, 1, 0}, {0, 0, 0}));
  EXPECT_FALSE(trace(bvh, {0, 1, 0}, {0, 0, -1}, nan));
}

TEST(Traversal, barycentrics_weigh_corners_one_and_two) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::one_triangle());
  const glm::vec3 p = 0.5F * glm::vec3(-1, -1, -2) + 0.3F * glm::vec3(1, -1, -2) + 0.2F * glm::vec3(0, 1, -2);
  const auto hit = trace(bvh, {0, 0, 0}, p);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->u, 0.3F, 1e-6F);
  EXPECT_NEAR(hit->v, 0.2F, 1e-6F);
}

// Walks the tree as the shader reads it.
class Walk {
 public:
  explicit Walk(const Bvh4& bvh) : bvh_(bvh) { node(0, 1, glm::vec3(-1e30F), glm::vec3(1e30F)); }

  std::set<std::uint32_t> leaf_triangles;
  std::uint32_t depth = 0, nodes = 0;

 private:
  void node(std::uint32_t index, std::uint32_t level, const glm::vec3& low, const glm::vec3& high) {
    ++nodes;
    depth = std::max(depth, level);
    ASSERT_LT((index + 1) * render::kBvhNodeTexels, bvh_.nodes.size() + 1);
    const glm::uvec4* q = &bvh_.nodes[index * render::kBvhNodeTexels];
    const glm::vec3 origin(std::bit_cast<float>(q[0].x), std::bit_cast<float>(q[0].y), std::bit_cast<float>(q[0].z));
    const glm::vec3 scale(std::bit_cast<float>(q[0].w), std::bit_cast<float>(q[1].x), std::bit_cast<float>(q[1].y));
    for (int i = 0; i < 4; ++i) {
      const auto byte = [&](std::uint32_t word) { return static_cast<float>((word >> (8 * i)) & 255U); };
      const glm::vec3 child_low = origin + scale * glm::vec3(byte(q[1].z), byte(q[2].x), byte(q[2].z));
      const glm::vec3 child_high = origin + scale * glm::vec3(byte(q[1].w), byte(q[2].y), byte(q[2].w));
      const std::uint32_t reference = q[3][i];
      if (reference == render::kBvhNoChild) {
        EXPECT_TRUE(glm::all(glm::greaterThan(child_low, child_high)));
      } else if ((reference & render::kBvhLeafBit) != 0) {
        leaf(reference, glm::max(low, child_low), glm::min(high, child_high));
      } else {
        node(reference, level + 1, glm::max(low, child_low), glm::min(high, child_high));
      }
    }
  }

  // Every corner lies inside the boxes of all nodes above.
  void leaf(std::uint32_t reference, const glm::vec3& low, const glm::vec3& high) {
    const std::uint32_t count = reference & render::kBvhLeafCountMask;
    const std::uint32_t first = (reference >> render::kBvhLeafFirstShift) & render::kBvhLeafFirstMask;
    EXPECT_GE(count, 1U);
    EXPECT_LE(count, render::kBvhMaxLeafTriangles);
    for (std::uint32_t i = first; i < first + count; ++i) {
      EXPECT_TRUE(leaf_triangles.insert(i).second) << "triangle " << i << " stands in two leaves";
      const glm::vec4* t = &bvh_.triangles.at(i * render::kBvhTriangleTexels);
      const glm::vec3 v0(t[0]), v1 = v0 + glm::vec3(t[1]), v2 = v0 + glm::vec3(t[2]);
      for (const glm::vec3& p : {v0, v1, v2}) {
        EXPECT_TRUE(glm::all(glm::lessThan(low, p)) && glm::all(glm::lessThan(p, high)));
      }
    }
  }

  const Bvh4& bvh_;
};

void expect_sound(const Scene& scene, std::size_t triangles) {
  const Bvh4 bvh = render::build_bvh4(scene);
  const Walk walk(bvh);
  EXPECT_EQ(bvh.triangles.size(), triangles * render::kBvhTriangleTexels);
  EXPECT_EQ(walk.leaf_triangles.size(), triangles);
  EXPECT_EQ(walk.nodes * render::kBvhNodeTexels, bvh.nodes.size());
  EXPECT_EQ(walk.depth, bvh.max_depth);
  EXPECT_LE(bvh.max_depth * 3 + 1, render::kBvhStackSize);
  std::set<std::uint32_t> originals;
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto original = std::bit_cast<std::uint32_t>(bvh.triangles[i * render::kBvhTriangleTexels + 1].w);
    EXPECT_TRUE(originals.insert(original).second);
    ASSERT_LT(original, scene.triangles.size());
    const glm::vec3 v0 = scene.vertices[scene.triangles[original].x].position;
    EXPECT_EQ(glm::vec3(bvh.triangles[i * render::kBvhTriangleTexels]), v0);
  }
}

TEST(Bvh4, every_triangle_stands_once_inside_its_boxes) {
  expect_sound(scene_oracle::one_triangle(), 1);
  expect_sound(scene_oracle::waves(60), 7200);
  expect_sound(scene_oracle::nested_boxes(), (12 + 144) * 12);
  expect_sound(scene_oracle::far_soup(kSeed, 5000), 5000);
}

TEST(Bvh4, one_triangle_has_a_root_node) {
  const Bvh4 bvh = render::build_bvh4(scene_oracle::one_triangle());
  ASSERT_EQ(bvh.nodes.size(), render::kBvhNodeTexels);
  EXPECT_EQ(bvh.nodes[3].x, render::kBvhLeafBit | 1U);
  EXPECT_EQ(bvh.max_depth, 1U);
}

// Sizes and distances that double make the surface-area tree a chain; thousands of equal triangles cannot be split.
TEST(Bvh4, the_depth_is_bounded_for_chains_and_for_coincident_triangles) {
  Scene chain;
  for (int i = 0; i < 4000; ++i) {
    const float x = std::exp2(static_cast<float>(i) * (44.0F / 4000.0F) - 16.0F);
    scene_oracle::add_triangle(chain, {x, 0, 0}, {x, 0.1F * x, 0}, {x, 0, 0.1F * x});
  }
  expect_sound(chain, 4000);
  const Bvh4 bvh = render::build_bvh4(chain);
  const auto hit = trace(bvh, {1e9F, 0.001F, 0.001F}, {-1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 3999U);

  Scene same;
  for (int i = 0; i < 3000; ++i) scene_oracle::add_triangle(same, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  expect_sound(same, 3000);
}

// A binary chain of the greatest height, each link beside four leaves of larger surface: opening by surface alone would
// make as many wide levels as binary ones.
TEST(Bvh4, the_tallest_binary_tree_still_fits_the_stack) {
  render::BinaryBvh chain;
  const auto add = [&](float size, std::uint32_t height) {
    chain.nodes.push_back({.box = {glm::vec3(0.0F), glm::vec3(size)}, .height = height});
    return static_cast<std::uint32_t>(chain.nodes.size() - 1);
  };
  const auto leaf = [&](float size) {
    const std::uint32_t index = add(size, 0);
    chain.nodes[index].first = static_cast<std::uint32_t>(chain.order.size());
    chain.nodes[index].count = 1;
    chain.order.push_back(chain.nodes[index].first);
    return index;
  };
  const auto join = [&](std::uint32_t index, std::uint32_t left, std::uint32_t right) {
    chain.nodes[index].left = left;
    chain.nodes[index].right = right;
    return index;
  };
  std::uint32_t link = add(1.0F, 2 * render::kBvhMaxDepth);
  for (std::uint32_t height = 2 * render::kBvhMaxDepth; height > 2; --height) {
    const std::uint32_t side = add(50.0F, 2), a = add(40.0F, 1), b = add(40.0F, 1);
    join(a, leaf(30.0F), leaf(30.0F));
    join(b, leaf(30.0F), leaf(30.0F));
    const std::uint32_t next = add(1.0F, height - 1);
    join(link, next, join(side, a, b));
    link = next;
  }
  const std::uint32_t last = add(1.0F, 1);
  join(link, join(last, leaf(1.0F), leaf(1.0F)), leaf(1.0F));
  const Bvh4 bvh = render::collapse_to_four(chain);
  EXPECT_LE(bvh.max_depth, render::kBvhMaxDepth);
  std::set<std::uint32_t> leaves;
  for (std::size_t i = 3; i < bvh.nodes.size(); i += render::kBvhNodeTexels) {
    for (int child = 0; child < 4; ++child) {
      const std::uint32_t reference = bvh.nodes[i][child];
      if (reference != render::kBvhNoChild && (reference & render::kBvhLeafBit) != 0) {
        leaves.insert((reference >> render::kBvhLeafFirstShift) & render::kBvhLeafFirstMask);
      }
    }
  }
  EXPECT_EQ(leaves.size(), chain.order.size());
}

TEST(Bvh4, triangles_without_area_are_left_out) {
  Scene scene = scene_oracle::one_triangle();
  scene_oracle::add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  scene_oracle::add_triangle(scene, {3, 3, 3}, {3, 3, 3}, {3, 3, 3});
  expect_sound(scene, 1);
}

TEST(Bvh4, a_scene_without_any_area_is_refused) {
  Scene scene;
  scene.source = "flat.gltf";
  scene_oracle::add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  try {
    (void)render::build_bvh4(scene);
    FAIL() << "accepted";
  } catch (const tracking::InputError& error) {
    EXPECT_EQ(error.file(), "flat.gltf");
    EXPECT_EQ(error.field(), "meshes");
  }
}

TEST(Bvh4, building_twice_gives_the_same_bits) {
  const Scene scene = scene_oracle::waves(150);
  const Bvh4 a = render::build_bvh4(scene), b = render::build_bvh4(scene);
  EXPECT_EQ(a.nodes, b.nodes);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(glm::vec4)), 0);
}

TEST(Bvh4, shading_data_follow_the_leaf_order) {
  Scene scene = scene_oracle::waves(10);
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    scene.vertices[i].uv = glm::vec2(static_cast<float>(i), -static_cast<float>(i));
  }
  const Bvh4 bvh = render::build_bvh4(scene);
  const auto shading = render::shading_triangles(scene, bvh);
  ASSERT_EQ(shading.size(), scene.triangles.size());
  for (std::size_t i = 0; i < shading.size(); ++i) {
    const auto original = std::bit_cast<std::uint32_t>(bvh.triangles[i * render::kBvhTriangleTexels + 1].w);
    for (int corner = 0; corner < 3; ++corner) {
      const render::Vertex& vertex = scene.vertices[scene.triangles[original][corner]];
      const glm::vec4 texel = shading[i].normal_u[static_cast<std::size_t>(corner)];
      EXPECT_EQ(glm::vec3(texel), vertex.normal);
      EXPECT_EQ(texel.w, vertex.uv.x);
      EXPECT_EQ(shading[i].v[corner], vertex.uv.y);
    }
  }
}

TEST(RayQuery, distance_is_in_metres_whatever_the_directions_length) {
  const render::RayQuery query(scene_oracle::one_triangle());
  const auto hit = query.closest({0.1, 0.1, 1.0}, {0, 0, -0.01});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 3.0);
  EXPECT_EQ(hit->triangle, 0U);
  EXPECT_TRUE(query.closest({0, 0, -5}, {0, 0, 10})) << "from behind";
}

TEST(RayQuery, nothing_for_misses_and_unsound_rays) {
  const render::RayQuery query(scene_oracle::one_triangle());
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(query.closest({0, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(query.closest({0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(query.closest({0, 0, 0}, {0, 0, -inf}));
  EXPECT_FALSE(query.closest({0, nan, 0}, {0, 0, -1}));
  EXPECT_FALSE(query.closest({0, 0, 0}, {nan, 0, -1}));
}

TEST(RayQuery, an_eye_looks_past_backs_and_clear_panes) {
  render::Scene scene = scene_oracle::one_triangle();
  const auto look = [&](double z) {  // at the triangle at z = -2
    return render::RayQuery(scene).looked_at({0.1, 0.1, z}, {0, 0, z > -2 ? -1 : 1});
  };
  EXPECT_NE(look(1.0).has_value(), look(-5.0).has_value()) << "one of its sides is its back";
  scene.materials[0].double_sided = true;
  EXPECT_TRUE(look(1.0) && look(-5.0));
  EXPECT_NEAR(look(1.0)->distance, 3.0, 1e-6);
  scene.materials[0].alpha = render::Material::Alpha::blend;
  EXPECT_TRUE(look(1.0)) << "opaque for all its mode says";
  scene.materials[0].base_colour.a = 0.25F;
  EXPECT_FALSE(look(1.0));
  EXPECT_TRUE(render::RayQuery(scene).closest({0.1, 0.1, 1.0}, {0, 0, -1}));
}

TEST(RayQuery, survives_a_move_and_finds_the_nearest) {
  render::RayQuery first(scene_oracle::nested_boxes());
  const render::RayQuery query = std::move(first);
  const auto hit = query.closest({0.3, 100.0, 0.2}, {0, -1, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 84.0, 1e-12);  // the outermost box is 16 m high
}

}  // namespace

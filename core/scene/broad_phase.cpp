// SPDX-License-Identifier: MIT
#include "core/scene/broad_phase.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>

namespace dmrp::core {
namespace {

using Object = fcl::CollisionObjectd;
using Tree = fcl::DynamicAABBTreeCollisionManagerd;

// The index of an object is stored in FCL's user data pointer.
void set_index(Object& object, std::size_t index) {
  object.setUserData(reinterpret_cast<void*>(index));
}
std::uint32_t index_of(const Object& object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::size_t>(object.getUserData()));
}

// What a tree knows of an object is its box. All boxes have the same height.
class BoxObject : public Object {
 public:
  explicit BoxObject(const toolkit::Rectangle& box) : Object(std::make_shared<fcl::Sphered>(0.0)) { cover(box); }

  void cover(const toolkit::Rectangle& box) {
    aabb = fcl::AABBd({box.lower.x, box.lower.y, 0.0}, {box.upper.x, box.upper.y, 0.0});
  }
};

// The query of this thread: trees are shared, and a query that allocates its object costs twice as much.
Object& query_for(const toolkit::Rectangle& box) {
  thread_local BoxObject query(box);
  query.cover(box);
  return query;
}

// The object of a pair that is not `query`.
std::uint32_t other_index(const Object* query, const Object* one, const Object* two) {
  return index_of(one == query ? *two : *one);
}

}  // namespace

struct BoxTree::Implementation {
  std::vector<std::unique_ptr<Object>> objects;
  Tree tree;
};

BoxTree::BoxTree(std::span<const toolkit::Rectangle> boxes) : implementation_(std::make_unique<Implementation>()) {
  std::vector<Object*> pointers;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    implementation_->objects.push_back(std::make_unique<BoxObject>(boxes[i]));
    set_index(*implementation_->objects.back(), i);
    pointers.push_back(implementation_->objects.back().get());
  }
  implementation_->tree.registerObjects(pointers);
  implementation_->tree.setup();
}

BoxTree::~BoxTree() = default;

void BoxTree::touching(const toolkit::Rectangle& box, std::vector<std::uint32_t>& found) const {
  assert(toolkit::is_ordered(box));
  found.clear();
  Object& query = query_for(box);
  struct Search {
    const Object* query;
    std::vector<std::uint32_t>* found;
  } search{&query, &found};
  implementation_->tree.collide(&query, &search, [](Object* one, Object* two, void* data) {
    auto* const into = static_cast<Search*>(data);
    into->found->push_back(other_index(into->query, one, two));
    return false;  // go on
  });
  std::sort(found.begin(), found.end());
}

std::pair<double, std::uint32_t> BoxTree::nearest(dmrp_vec2 point,
                                                  const std::function<double(std::uint32_t)>& distance_to) const {
  Object& query = query_for({point, point});
  struct Search {
    const Object* query;
    const std::function<double(std::uint32_t)>* distance_to;
    double distance;
    std::uint32_t index;
  } search{&query, &distance_to, std::numeric_limits<double>::infinity(),
           static_cast<std::uint32_t>(implementation_->objects.size())};
  // FCL skips boxes at or beyond the least distance so far. The next larger double keeps equal distances.
  implementation_->tree.distance(&query, &search, [](Object* one, Object* two, void* data, double& least) {
    auto* const best = static_cast<Search*>(data);
    const std::uint32_t index = other_index(best->query, one, two);
    const double distance = (*best->distance_to)(index);
    if (distance < best->distance || (distance == best->distance && index < best->index)) {
      best->distance = distance;
      best->index = index;
    }
    least = std::nextafter(best->distance, std::numeric_limits<double>::infinity());
    return false;  // go on
  });
  return {search.distance, search.index};
}

struct BodyPairs::Implementation {
  std::vector<double> radii;
  std::vector<std::unique_ptr<Object>> objects;
  std::unique_ptr<Tree> tree;

  void build(std::span<const double> new_radii) {
    tree = std::make_unique<Tree>();
    objects.clear();
    radii.assign(new_radii.begin(), new_radii.end());
    std::vector<Object*> pointers;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      objects.push_back(std::make_unique<Object>(std::make_shared<fcl::Sphered>(radii[i])));
      set_index(*objects.back(), i);
      pointers.push_back(objects.back().get());
    }
    tree->registerObjects(pointers);
    tree->setup();
  }
};

BodyPairs::BodyPairs() : implementation_(std::make_unique<Implementation>()) {}
BodyPairs::~BodyPairs() = default;

void BodyPairs::touching(std::span<const dmrp_vec2> centers, std::span<const double> radii,
                         std::vector<std::pair<std::uint32_t, std::uint32_t>>& found) {
  assert(centers.size() == radii.size());
  found.clear();
  Implementation& my = *implementation_;
  if (!my.tree || !std::equal(radii.begin(), radii.end(), my.radii.begin(), my.radii.end())) my.build(radii);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    my.objects[i]->setTranslation(fcl::Vector3d(centers[i].x, centers[i].y, 0.0));
    my.objects[i]->computeAABB();
  }
  my.tree->update();
  my.tree->collide(&found, [](Object* one, Object* two, void* data) {
    auto* const pairs = static_cast<std::vector<std::pair<std::uint32_t, std::uint32_t>>*>(data);
    pairs->emplace_back(std::minmax(index_of(*one), index_of(*two)));
    return false;  // go on
  });
  // The tree's order depends on its history.
  std::sort(found.begin(), found.end());
}

}  // namespace dmrp::core

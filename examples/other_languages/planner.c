/* SPDX-License-Identifier: MIT */
// The template's planner, prioritized planning, in plain C99 with the C headers alone. It makes the same plans: the
// order in which its search looks at nodes is total, and the same in all three languages.
#include <dmrp/c_plugin.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define UNREACHABLE UINT32_MAX
#define TOUCHING_CELLS 1.4142135623731  // discs on neighbouring cells can touch below sqrt(2) cells

struct dmrp_instance {
  const dmrp_host* host;
  int64_t orders;
};

static const dmrp_param_spec params[] = {{.key = "orders",
                                          .type = DMRP_PARAM_INT,
                                          .integer = 100,
                                          .doc = "orders of the robots that it tries",
                                          .minimum = 1.0,
                                          .maximum = 1e6}};

static const dmrp_planner_traits traits = {.struct_size = sizeof(dmrp_planner_traits),
                                           .connectivity = DMRP_CONNECTIVITY_4};

static const dmrp_descriptor prioritized = {
    .struct_size = sizeof(dmrp_descriptor),
    .kind = DMRP_KIND_GLOBAL_PLANNER,
    .id = "org.example.planner_in_c",
    .name = "Prioritized planning in C",
    .version = "0.1.0",
    .vendor = "Example",
    .license = "MIT",
    .summary = "robots plan one after the other, around the paths of those before them",
    .source = "Erdmann, Lozano-Perez: On multiple moving objects, Algorithmica 2 (1987)",
    .params = params,
    .param_count = 1,
    .param_stride = sizeof(dmrp_param_spec),
    .traits = &traits};

// One step of a path: the cell at its end, and the goal that it leads to, counted from the robot's remaining goals.
typedef struct step {
  uint32_t cell;
  uint32_t goal;
} step;

typedef struct steps {
  step* at;
  size_t count;
} steps;

// What one active robot has to do, on its own grid.
typedef struct task {
  uint32_t robot;
  uint32_t start;
  uint32_t goal_count;
  const dmrp_grid* grid;
  uint32_t* goals;       // cells, in the order of the tour
  uint32_t* steps_left;  // of each goal a grid: from each cell over this goal to the last one
} task;

typedef struct node {
  uint32_t time;  // steps since the plan takes effect
  uint32_t cell;
  uint32_t goal;  // the next one; goal_count when all are reached and the robot can stay
  size_t parent;
} node;

typedef struct entry {
  uint32_t length;  // estimated, of the path through the node
  uint32_t time;
  size_t node;
} entry;

// One call of plan(), and all memory that it uses.
typedef struct planning {
  const dmrp_instance* self;
  const dmrp_planning_problem* problem;
  task* tasks;
  size_t task_count;
  steps* paths;      // by robot
  bool* is_planned;  // by robot: the others go around its path
  node* nodes;
  entry* open;  // a heap, with as many elements as there are nodes at most
  size_t node_count, open_count, capacity;
  uint64_t expanded;
} planning;

// ---- the grid

static const uint8_t edges[] = {DMRP_EDGE_E, DMRP_EDGE_N, DMRP_EDGE_W, DMRP_EDGE_S};

static uint32_t neighbour(const dmrp_grid* grid, uint32_t cell, uint8_t edge) {
  if (edge == DMRP_EDGE_E) return cell + 1;
  if (edge == DMRP_EDGE_N) return cell + grid->width;
  return edge == DMRP_EDGE_W ? cell - 1 : cell - grid->width;
}

static uint32_t cell_of(const dmrp_grid* grid, double x, double y) {
  const uint32_t column = (uint32_t)floor((x - grid->origin.x) / grid->resolution_m);
  const uint32_t row = (uint32_t)floor((y - grid->origin.y) / grid->resolution_m);
  return row * grid->width + column;
}

// The number of steps from each cell to `goal`, plus `rest`: breadth-first. `queue` has room for all cells.
static void find_steps_to(const dmrp_grid* grid, uint32_t goal, uint32_t rest, uint32_t* steps_to, uint32_t* queue) {
  const size_t cells = (size_t)grid->width * grid->height;
  for (size_t i = 0; i < cells; ++i) steps_to[i] = UNREACHABLE;
  if (rest == UNREACHABLE) return;
  size_t count = 0;
  queue[count++] = goal;
  steps_to[goal] = rest;
  for (size_t next = 0; next < count; ++next)
    for (size_t i = 0; i < 4; ++i) {
      if (!(grid->edges[queue[next]] & edges[i])) continue;  // edges are mutual
      const uint32_t to = neighbour(grid, queue[next], edges[i]);
      if (steps_to[to] != UNREACHABLE) continue;
      steps_to[to] = steps_to[queue[next]] + 1;
      queue[count++] = to;
    }
}

// ---- paths of the robots before

static uint32_t cell_at(const steps* path, size_t time) {
  return path->at[time < path->count ? time : path->count - 1].cell;
}

static bool is_blocked(const planning* p, uint32_t from, uint32_t to, size_t time) {
  for (uint32_t robot = 0; robot < p->problem->robot_count; ++robot) {
    if (!p->is_planned[robot]) continue;
    const uint32_t other = cell_at(&p->paths[robot], time);
    if (other == to || (other == from && cell_at(&p->paths[robot], time - 1) == to)) return true;  // or a swap
  }
  return false;
}

// From this time on, the planned robots rest at their goals.
static size_t time_of_rest(const planning* p) {
  size_t still = 0;
  for (uint32_t robot = 0; robot < p->problem->robot_count; ++robot)
    if (p->is_planned[robot] && p->paths[robot].count > still) still = p->paths[robot].count;
  return still;
}

static bool can_stay(const planning* p, uint32_t cell, size_t time, size_t still) {
  for (; time <= still; ++time)
    if (is_blocked(p, cell, cell, time + 1)) return false;
  return true;
}

static uint32_t goal_after(const planning* p, const task* t, uint32_t cell, uint32_t goal, size_t time, size_t still) {
  if (cell != t->goals[goal]) return goal;
  return goal + 1 < t->goal_count || can_stay(p, cell, time, still) ? goal + 1 : goal;
}

// ---- the queue: first the shortest estimated path, then the later time, then the older node

static bool is_before(const entry* a, const entry* b) {
  if (a->length != b->length) return a->length < b->length;
  if (a->time != b->time) return a->time > b->time;
  return a->node < b->node;
}

static void push(planning* p, entry added) {
  size_t at = p->open_count++;
  for (; at > 0 && is_before(&added, &p->open[(at - 1) / 2]); at = (at - 1) / 2) p->open[at] = p->open[(at - 1) / 2];
  p->open[at] = added;
}

static size_t pop(planning* p) {
  const size_t first = p->open[0].node;
  const entry moved = p->open[--p->open_count];
  size_t at = 0;
  for (size_t child = 1; child < p->open_count; child = 2 * at + 1) {
    if (child + 1 < p->open_count && is_before(&p->open[child + 1], &p->open[child])) ++child;
    if (!is_before(&p->open[child], &moved)) break;
    p->open[at] = p->open[child];
    at = child;
  }
  p->open[at] = moved;
  return first;
}

static int32_t add(planning* p, const task* t, node added) {
  const size_t cells = (size_t)t->grid->width * t->grid->height;
  const uint32_t left = added.goal < t->goal_count ? t->steps_left[added.goal * cells + added.cell] : 0;
  if (left == UNREACHABLE) return DMRP_OK;
  if (p->node_count == p->capacity) {
    const size_t capacity = p->capacity ? 2 * p->capacity : 1024;
    node* nodes = realloc(p->nodes, capacity * sizeof(node));
    if (nodes) p->nodes = nodes;
    entry* open = realloc(p->open, capacity * sizeof(entry));
    if (open) p->open = open;
    if (!nodes || !open) return DMRP_OUT_OF_MEMORY;
    p->capacity = capacity;
  }
  push(p, (entry){added.time + left, added.time, p->node_count});
  p->nodes[p->node_count++] = added;
  return DMRP_OK;
}

// ---- one robot

// The cells from the start to the node `last`. A waypoint belongs to the goal that the robot was heading for before it.
static int32_t keep_path(planning* p, uint32_t robot, size_t last) {
  const size_t count = (size_t)p->nodes[last].time + 1;
  step* path = malloc(count * sizeof(step));
  if (!path) return DMRP_OUT_OF_MEMORY;
  for (size_t i = last, left = count; left-- > 0; i = p->nodes[i].parent)
    path[left] = (step){p->nodes[i].cell, i == 0 ? 0 : p->nodes[p->nodes[i].parent].goal};
  free(p->paths[robot].at);
  p->paths[robot] = (steps){path, count};
  return DMRP_OK;
}

static int32_t expand(planning* p, const task* t, size_t from, size_t still) {
  const node parent = p->nodes[from];
  int32_t status = DMRP_OK;
  for (size_t i = 0; i < 5 && status == DMRP_OK; ++i) {
    if (i > 0 && !(t->grid->edges[parent.cell] & edges[i - 1])) continue;
    const uint32_t to = i == 0 ? parent.cell : neighbour(t->grid, parent.cell, edges[i - 1]);  // first a wait
    if (is_blocked(p, parent.cell, to, parent.time + 1)) continue;
    const uint32_t goal = goal_after(p, t, to, parent.goal, parent.time + 1, still);
    status = add(p, t, (node){parent.time + 1, to, goal, from});
  }
  return status;
}

// A* over cells, goals and time. DMRP_NO_SOLUTION if there is no path around the others, DMRP_TIMEOUT without time.
static int32_t find_shortest_path(planning* p, const task* t) {
  const size_t still = time_of_rest(p);
  const size_t times = still + 2;
  const size_t cells = (size_t)t->grid->width * t->grid->height;
  uint8_t* is_closed = calloc(times * t->goal_count * cells, 1);
  if (!is_closed) return DMRP_OUT_OF_MEMORY;
  p->node_count = p->open_count = 0;

  int32_t status = add(p, t, (node){0, t->start, goal_after(p, t, t->start, 0, 0, still), 0});
  size_t found = SIZE_MAX;
  while (status == DMRP_OK && p->open_count > 0 && found == SIZE_MAX) {
    if (p->self->host->should_stop(p->self->host)) {
      status = DMRP_TIMEOUT;
      break;
    }
    const size_t index = pop(p);
    const node now = p->nodes[index];
    if (now.goal == t->goal_count) {
      found = index;
      break;
    }
    const size_t time = now.time < times - 1 ? now.time : times - 1;
    uint8_t* closed = &is_closed[(time * t->goal_count + now.goal) * cells + now.cell];
    if (*closed) continue;
    *closed = 1;
    ++p->expanded;
    status = expand(p, t, index, still);
  }
  free(is_closed);
  if (status != DMRP_OK) return status;
  return found == SIZE_MAX ? DMRP_NO_SOLUTION : keep_path(p, t->robot, found);
}

// ---- all robots

static const dmrp_planning_robot* robot_at(const dmrp_planning_problem* problem, size_t index) {
  return DMRP_AT(dmrp_planning_robot, problem->robots, problem->robot_stride, index);
}

// Robots in different cells can touch if cells are small: then equal cells are not the only conflict.
static bool robots_can_touch_across_cells(const dmrp_planning_problem* problem) {
  double largest_m = 0.0;
  for (uint32_t i = 0; i < problem->robot_count; ++i)
    largest_m = fmax(largest_m, robot_at(problem, i)->robot->footprint->radius_m);
  return problem->robot_count > 1 && problem->grid->resolution_m < TOUCHING_CELLS * 2.0 * largest_m;
}

static int32_t add_task(planning* p, const dmrp_planning_robot* robot, uint32_t index) {
  const dmrp_grid* grid = robot->grid;  // free cells and edges for this robot's footprint
  const size_t cells = (size_t)grid->width * grid->height;
  task* t = &p->tasks[p->task_count++];
  *t = (task){.robot = index, .goal_count = robot->goal_count, .grid = grid};
  t->start = cell_of(grid, robot->start.x, robot->start.y);
  t->goals = malloc(robot->goal_count * sizeof(uint32_t));
  t->steps_left = malloc(robot->goal_count * cells * sizeof(uint32_t));
  uint32_t* queue = malloc(cells * sizeof(uint32_t));
  const bool has_memory = t->goals && t->steps_left && queue;
  uint32_t rest = 0;
  for (uint32_t i = 0; has_memory && i < robot->goal_count; ++i) {
    const dmrp_goal* goal = DMRP_AT(dmrp_goal, robot->goals, robot->goal_stride, i);
    t->goals[i] = cell_of(grid, goal->pose.x, goal->pose.y);
  }
  for (uint32_t i = robot->goal_count; has_memory && i-- > 0;) {
    uint32_t* steps_left = &t->steps_left[i * cells];
    find_steps_to(grid, t->goals[i], rest, steps_left, queue);
    rest = steps_left[i > 0 ? t->goals[i - 1] : t->start];
  }
  free(queue);
  return has_memory ? DMRP_OK : DMRP_OUT_OF_MEMORY;
}

// Every robot stands at its start; those that are active get a task.
static int32_t begin(planning* p) {
  const uint32_t count = p->problem->robot_count;
  p->tasks = calloc(count + 1, sizeof(task));
  p->paths = calloc(count + 1, sizeof(steps));
  p->is_planned = calloc(count + 1, sizeof(bool));
  if (!p->tasks || !p->paths || !p->is_planned) return DMRP_OUT_OF_MEMORY;
  for (uint32_t i = 0; i < count; ++i) {
    const dmrp_planning_robot* robot = robot_at(p->problem, i);
    p->paths[i].at = malloc(sizeof(step));
    if (!p->paths[i].at) return DMRP_OUT_OF_MEMORY;
    p->paths[i].at[0] = (step){cell_of(robot->grid, robot->start.x, robot->start.y), 0};
    p->paths[i].count = 1;
    if (robot->state != DMRP_ROBOT_ACTIVE) continue;
    const int32_t status = add_task(p, robot, i);
    if (status != DMRP_OK) return status;
    const task* t = &p->tasks[p->task_count - 1];
    if (t->steps_left[t->start] == UNREACHABLE) {
      char text[80];
      snprintf(text, sizeof(text), "robot %u cannot reach its goal", i);
      p->self->host->set_error(p->self->host, text);
      return DMRP_NO_SOLUTION;
    }
  }
  return DMRP_OK;
}

// Plans all tasks in their order. If one finds no path, it moves to the front, and the answer is DMRP_NO_SOLUTION.
static int32_t plan_in_order(planning* p) {
  for (uint32_t i = 0; i < p->problem->robot_count; ++i) p->is_planned[i] = true;
  for (size_t i = 0; i < p->task_count; ++i) p->is_planned[p->tasks[i].robot] = false;
  for (size_t i = 0; i < p->task_count; ++i) {
    const int32_t status = find_shortest_path(p, &p->tasks[i]);
    if (status == DMRP_NO_SOLUTION) {
      const task stuck = p->tasks[i];
      memmove(&p->tasks[1], &p->tasks[0], i * sizeof(task));
      p->tasks[0] = stuck;
    }
    if (status != DMRP_OK) return status;
    p->is_planned[p->tasks[i].robot] = true;
  }
  return DMRP_OK;
}

// The first waypoint is the robot's start, at the moment when the plan takes effect; one more follows for each step,
// also for a wait, which repeats its cell. The heading is NaN: any.
static int32_t give_path(const planning* p, uint32_t index, dmrp_plan_sink* sink) {
  const dmrp_planning_robot* robot = robot_at(p->problem, index);
  const dmrp_grid* grid = robot->grid;
  const steps* path = &p->paths[index];
  dmrp_waypoint* waypoints = calloc(path->count, sizeof(dmrp_waypoint));
  if (!waypoints) return DMRP_OUT_OF_MEMORY;
  for (size_t i = 0; i < path->count; ++i) {
    const uint32_t cell = path->at[i].cell;
    waypoints[i].x = grid->origin.x + (cell % grid->width + 0.5) * grid->resolution_m;
    waypoints[i].y = grid->origin.y + (cell / grid->width + 0.5) * grid->resolution_m;
    waypoints[i].theta = NAN;
    waypoints[i].t_ns = p->problem->effective_from_ns + (int64_t)i * p->problem->step_duration_ns;
    waypoints[i].goal_index = robot->first_goal_index + path->at[i].goal;
  }
  const dmrp_path given = {sizeof(dmrp_path), (uint32_t)path->count, sizeof(dmrp_waypoint), 0, waypoints};
  const int32_t status = sink->path(sink, index, &given);
  free(waypoints);
  return status;
}

static int32_t give(const planning* p, dmrp_plan_sink* sink) {
  size_t cost = 0;
  int32_t status = DMRP_OK;
  for (uint32_t i = 0; i < p->problem->robot_count && status == DMRP_OK; ++i) {
    status = give_path(p, i, sink);
    cost += p->paths[i].count - 1;
  }
  if (status == DMRP_OK) status = sink->statistic(sink, "cost", (double)cost);
  return status;
}

static void release(planning* p) {
  for (size_t i = 0; i < p->task_count; ++i) {
    free(p->tasks[i].goals);
    free(p->tasks[i].steps_left);
  }
  for (uint32_t i = 0; p->paths && i < p->problem->robot_count; ++i) free(p->paths[i].at);
  free(p->tasks);
  free(p->paths);
  free(p->is_planned);
  free(p->nodes);
  free(p->open);
}

static int32_t plan(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink) {
  if (robots_can_touch_across_cells(problem)) {
    self->host->set_error(self->host, "this planner needs cells of at least 1.42 times the robots' diameter");
    return DMRP_NO_SOLUTION;  // a correct answer: `dmrp-host validate` shows the text
  }
  planning p = {.self = self, .problem = problem};
  int32_t status = begin(&p);
  if (status == DMRP_OK) {
    status = DMRP_NO_SOLUTION;
    for (int64_t order = 0; order < self->orders && status == DMRP_NO_SOLUTION; ++order) status = plan_in_order(&p);
    if (status == DMRP_NO_SOLUTION) status = DMRP_TIMEOUT;  // its own limit, which proves nothing
    if (status == DMRP_OK) status = give(&p, sink);
    sink->statistic(sink, "low_level_expanded", (double)p.expanded);
  }
  release(&p);
  return status;
}

// ---- the library

static const dmrp_global_planner planner = {.struct_size = sizeof(dmrp_global_planner), .plan = plan};

static int32_t start(dmrp_instance* self, const dmrp_start* start) {
  (void)self;
  (void)start;
  return DMRP_OK;
}
static void destroy(dmrp_instance* self) {
  free(self);
}

static int32_t make(const dmrp_host* host, const dmrp_descriptor* plugin, const dmrp_params* values, dmrp_plugin* out) {
  (void)plugin;
  out->self = malloc(sizeof(dmrp_instance));
  if (!out->self) return DMRP_OUT_OF_MEMORY;
  out->self->host = host;  // valid until destroy() returns
  out->self->orders = dmrp_param_of(values, "orders")->integer;
  out->table = &planner;
  out->start = start;
  out->destroy = destroy;
  return DMRP_OK;
}

DMRP_C_PLUGINS(make, &prioritized);

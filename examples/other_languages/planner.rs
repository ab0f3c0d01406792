// SPDX-License-Identifier: MIT
// The template's planner, prioritized planning, in Rust, with bindings written from the C headers (dmrp.rs). It makes
// the same plans: the order in which its search looks at nodes is total, and the same in all three languages.
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ffi::CStr;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, AssertUnwindSafe};

mod dmrp;
use dmrp::*;

const UNREACHABLE: u32 = u32::MAX;
const TOUCHING_CELLS: f64 = 1.4142135623731; // discs on neighbouring cells can touch below sqrt(2) cells
const EDGES: [u32; 4] = [DMRP_EDGE_E, DMRP_EDGE_N, DMRP_EDGE_W, DMRP_EDGE_S];

// One step of a path: the cell at its end, and the goal that it leads to, counted from the robot's remaining goals.
#[derive(Clone, Copy)]
struct Step {
    cell: u32,
    goal: usize,
}

// A grid of the host, valid while plan() runs.
#[derive(Clone, Copy)]
struct Grid<'a> {
    c: &'a dmrp_grid,
    edges: &'a [u8],
}

impl<'a> Grid<'a> {
    unsafe fn new(c: &'a dmrp_grid) -> Self {
        let cells = c.width as usize * c.height as usize;
        Grid { c, edges: std::slice::from_raw_parts(c.edges, cells) }
    }
    fn size(&self) -> usize {
        self.edges.len()
    }
    fn cell_of(&self, x: f64, y: f64) -> u32 {
        let column = ((x - self.c.origin.x) / self.c.resolution_m).floor() as u32;
        let row = ((y - self.c.origin.y) / self.c.resolution_m).floor() as u32;
        row * self.c.width + column
    }
    fn center(&self, cell: u32) -> (f64, f64) {
        let along = |index: u32, origin: f64| origin + (index as f64 + 0.5) * self.c.resolution_m;
        (along(cell % self.c.width, self.c.origin.x), along(cell / self.c.width, self.c.origin.y))
    }
    fn has_edge(&self, cell: u32, edge: u32) -> bool {
        u32::from(self.edges[cell as usize]) & edge != 0
    }
    // Where an edge leads.
    fn neighbour(&self, cell: u32, edge: u32) -> u32 {
        match edge {
            DMRP_EDGE_E => cell + 1,
            DMRP_EDGE_N => cell + self.c.width,
            DMRP_EDGE_W => cell - 1,
            _ => cell - self.c.width,
        }
    }
    // The number of steps from each cell to `goal`, plus `rest`: breadth-first.
    fn steps_to(&self, goal: u32, rest: u32) -> Vec<u32> {
        let mut steps = vec![UNREACHABLE; self.size()];
        if rest == UNREACHABLE {
            return steps;
        }
        steps[goal as usize] = rest;
        let mut queue = vec![goal];
        let mut next = 0;
        while next < queue.len() {
            let from = queue[next];
            next += 1;
            for edge in EDGES {
                if !self.has_edge(from, edge) {
                    continue; // edges are mutual
                }
                let to = self.neighbour(from, edge);
                if steps[to as usize] == UNREACHABLE {
                    steps[to as usize] = steps[from as usize] + 1;
                    queue.push(to);
                }
            }
        }
        steps
    }
}

// What one active robot has to do, on its own grid.
struct Task<'a> {
    robot: usize,
    grid: Grid<'a>,
    start: u32,
    goals: Vec<u32>,           // cells, in the order of the tour
    steps_left: Vec<Vec<u32>>, // [goal][cell]: over this goal to the last one
}

impl<'a> Task<'a> {
    unsafe fn new(index: usize, robot: &'a dmrp_planning_robot) -> Self {
        let grid = Grid::new(&*robot.grid); // free cells and edges for this robot's footprint
        let start = grid.cell_of(robot.start.x, robot.start.y);
        let goals: Vec<u32> = (0..robot.goal_count as usize)
            .map(|i| at(robot.goals, robot.goal_stride, i).pose)
            .map(|pose| grid.cell_of(pose.x, pose.y))
            .collect();
        let mut steps_left = vec![Vec::new(); goals.len()];
        let mut rest = 0;
        for i in (0..goals.len()).rev() {
            steps_left[i] = grid.steps_to(goals[i], rest);
            rest = steps_left[i][if i > 0 { goals[i - 1] } else { start } as usize];
        }
        Task { robot: index, grid, start, goals, steps_left }
    }
}

#[derive(Clone, Copy)]
struct Node {
    time: u32, // steps since the plan takes effect
    cell: u32,
    goal: usize, // the next one; the number of goals when all are reached and the robot can stay
    parent: usize,
}

enum Failure {
    NoPath,
    NoTime,
}

// The paths so far. Robots that are planned stand or move as these say; the others are not there yet.
struct Paths {
    steps: Vec<Vec<Step>>,
    planned: Vec<bool>,
}

impl Paths {
    fn cell_at(&self, robot: usize, time: usize) -> u32 {
        let steps = &self.steps[robot];
        steps[time.min(steps.len() - 1)].cell
    }
    fn is_blocked(&self, from: u32, to: u32, time: usize) -> bool {
        (0..self.steps.len()).filter(|&robot| self.planned[robot]).any(|robot| {
            let other = self.cell_at(robot, time);
            other == to || (other == from && self.cell_at(robot, time - 1) == to)
            // the same cell, or a swap
        })
    }
    // From this time on, the planned robots rest at their goals.
    fn time_of_rest(&self) -> usize {
        let lengths =
            self.steps.iter().zip(&self.planned).filter(|(_, &planned)| planned).map(|(steps, _)| steps.len());
        lengths.max().unwrap_or(0)
    }
    fn goal_after(&self, task: &Task, cell: u32, goal: usize, time: usize, still: usize) -> usize {
        let can_stay = || (time..=still).all(|t| !self.is_blocked(cell, cell, t + 1));
        if cell == task.goals[goal] && (goal + 1 < task.goals.len() || can_stay()) {
            goal + 1
        } else {
            goal
        }
    }
}

// A* over cells, goals and time; waits cost as much as moves.
struct Search<'a> {
    task: &'a Task<'a>,
    nodes: Vec<Node>,
    // first the shortest estimated path, then the later time, then the older node
    open: BinaryHeap<Reverse<(u32, u32, usize)>>,
}

impl<'a> Search<'a> {
    fn add(&mut self, node: Node) {
        let left = match self.task.steps_left.get(node.goal) {
            Some(steps) => steps[node.cell as usize],
            None => 0,
        };
        if left != UNREACHABLE {
            self.open.push(Reverse((node.time + left, u32::MAX - node.time, self.nodes.len())));
            self.nodes.push(node);
        }
    }

    fn run(mut self, paths: &Paths, expanded: &mut u64, should_stop: &dyn Fn() -> bool) -> Result<Vec<Step>, Failure> {
        let task = self.task;
        let still = paths.time_of_rest();
        let times = still + 2;
        let mut is_closed = vec![false; times * task.goals.len() * task.grid.size()];
        self.add(Node { time: 0, cell: task.start, goal: paths.goal_after(task, task.start, 0, 0, still), parent: 0 });
        while let Some(Reverse((_, _, index))) = self.open.pop() {
            if should_stop() {
                return Err(Failure::NoTime);
            }
            let node = self.nodes[index];
            if node.goal == task.goals.len() {
                return Ok(self.path_to(index));
            }
            let time = (node.time as usize).min(times - 1);
            let state = (time * task.goals.len() + node.goal) * task.grid.size() + node.cell as usize;
            if std::mem::replace(&mut is_closed[state], true) {
                continue;
            }
            *expanded += 1;
            let moves = EDGES.iter().filter(|&&edge| task.grid.has_edge(node.cell, edge));
            let moved = moves.map(|&edge| task.grid.neighbour(node.cell, edge));
            for to in std::iter::once(node.cell).chain(moved) {
                let time = node.time + 1;
                if !paths.is_blocked(node.cell, to, time as usize) {
                    let goal = paths.goal_after(task, to, node.goal, time as usize, still);
                    self.add(Node { time, cell: to, goal, parent: index });
                }
            }
        }
        Err(Failure::NoPath)
    }

    // A waypoint belongs to the goal that the robot was heading for before it.
    fn path_to(&self, last: usize) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut i = last;
        while i != 0 {
            let parent = self.nodes[i].parent;
            steps.push(Step { cell: self.nodes[i].cell, goal: self.nodes[parent].goal });
            i = parent;
        }
        steps.push(Step { cell: self.nodes[0].cell, goal: 0 });
        steps.reverse();
        steps
    }
}

struct Planner {
    host: *const dmrp_host, // valid until destroy() returns
    orders: i64,
}

impl Planner {
    fn should_stop(&self) -> bool {
        unsafe { ((*self.host).should_stop.unwrap())(self.host) != 0 }
    }
    fn set_error(&self, text: &str) {
        set_error(self.host, text);
    }

    unsafe fn plan(&self, problem: &dmrp_planning_problem, sink: *mut dmrp_plan_sink) -> i32 {
        let robots: Vec<&dmrp_planning_robot> =
            (0..problem.robot_count as usize).map(|i| at(problem.robots, problem.robot_stride, i)).collect();
        // Robots in different cells can touch if cells are small: then equal cells are not the only conflict.
        let largest_m = robots.iter().map(|robot| (*(*robot.robot).footprint).radius_m).fold(0.0, f64::max);
        if robots.len() > 1 && (*problem.grid).resolution_m < TOUCHING_CELLS * 2.0 * largest_m {
            self.set_error("this planner needs cells of at least 1.42 times the robots' diameter");
            return DMRP_NO_SOLUTION; // a correct answer: `dmrp-host validate` shows the text
        }

        let mut paths = Paths { steps: Vec::new(), planned: vec![true; robots.len()] };
        let mut tasks = Vec::new();
        for (i, robot) in robots.iter().enumerate() {
            let cell = Grid::new(&*robot.grid).cell_of(robot.start.x, robot.start.y);
            paths.steps.push(vec![Step { cell, goal: 0 }]);
            if robot.state == DMRP_ROBOT_ACTIVE as u32 {
                tasks.push(Task::new(i, robot)); // the others stand at their starts, as obstacles
            }
        }
        if let Some(task) = tasks.iter().find(|task| task.steps_left[0][task.start as usize] == UNREACHABLE) {
            self.set_error(&format!("robot {} cannot reach its goal", task.robot));
            return DMRP_NO_SOLUTION;
        }

        let mut expanded = 0;
        let mut status = DMRP_TIMEOUT; // its own limit, which proves nothing
        for _ in 0..self.orders {
            match self.plan_in_order(&mut tasks, &mut paths, &mut expanded) {
                Ok(()) => status = give(problem, &robots, &paths, sink),
                Err(Failure::NoPath) => continue,
                Err(Failure::NoTime) => {}
            }
            break;
        }
        ((*sink).statistic.unwrap())(sink, b"low_level_expanded\0".as_ptr() as *const c_char, expanded as f64);
        status
    }

    // Plans all tasks in their order. If one finds no path, it moves to the front.
    fn plan_in_order(&self, tasks: &mut [Task], paths: &mut Paths, expanded: &mut u64) -> Result<(), Failure> {
        paths.planned.fill(true);
        for task in tasks.iter() {
            paths.planned[task.robot] = false;
        }
        for i in 0..tasks.len() {
            let search = Search { task: &tasks[i], nodes: Vec::new(), open: BinaryHeap::new() };
            match search.run(paths, expanded, &|| self.should_stop()) {
                Ok(steps) => paths.steps[tasks[i].robot] = steps,
                Err(failure) => {
                    tasks[..=i].rotate_right(1);
                    return Err(failure);
                }
            }
            paths.planned[tasks[i].robot] = true;
        }
        Ok(())
    }
}

// The first waypoint is the robot's start, at the moment when the plan takes effect; one more follows for each step, also
// for a wait, which repeats its cell. The heading is NaN: any.
unsafe fn give(
    problem: &dmrp_planning_problem,
    robots: &[&dmrp_planning_robot],
    paths: &Paths,
    sink: *mut dmrp_plan_sink,
) -> i32 {
    let mut cost = 0;
    for (i, robot) in robots.iter().enumerate() {
        let grid = Grid::new(&*robot.grid);
        let waypoint = |(time, step): (usize, &Step)| {
            let (x, y) = grid.center(step.cell);
            let t_ns = problem.effective_from_ns + time as i64 * problem.step_duration_ns;
            let goal_index = robot.first_goal_index + step.goal as u32;
            dmrp_waypoint { x, y, theta: f64::NAN, t_ns, goal_index, reserved: 0 }
        };
        let waypoints: Vec<dmrp_waypoint> = paths.steps[i].iter().enumerate().map(waypoint).collect();
        let path = dmrp_path {
            struct_size: std::mem::size_of::<dmrp_path>() as u32,
            count: waypoints.len() as u32,
            stride: std::mem::size_of::<dmrp_waypoint>() as u32,
            flags: 0,
            waypoints: waypoints.as_ptr(),
        };
        let status = ((*sink).path.unwrap())(sink, i as u32, &path);
        if status != DMRP_OK {
            return status;
        }
        cost += waypoints.len() - 1;
    }
    ((*sink).statistic.unwrap())(sink, b"cost\0".as_ptr() as *const c_char, cost as f64)
}

// ---- the library

// Static data of the library, which nobody changes.
struct Shared<T>(T);
unsafe impl<T> Sync for Shared<T> {}

const fn text(bytes: &'static [u8]) -> *const c_char {
    bytes.as_ptr() as *const c_char
}

static PARAMETERS: Shared<[dmrp_param_spec; 1]> = Shared([dmrp_param_spec {
    key: text(b"orders\0"),
    r#type: DMRP_PARAM_INT,
    count: 0,
    integer: 100,
    number: 0.0,
    text: std::ptr::null(),
    numbers: std::ptr::null(),
    texts: std::ptr::null(),
    unit: text(b"\0"),
    doc: text(b"orders of the robots that it tries\0"),
    minimum: 1.0,
    maximum: 1e6,
    choices: std::ptr::null(),
    choice_count: 0,
    reserved: 0,
}]);

const ID: &[u8] = b"org.example.planner_in_rust\0";

static TRAITS: dmrp_planner_traits = dmrp_planner_traits {
    struct_size: std::mem::size_of::<dmrp_planner_traits>() as u32,
    connectivity: DMRP_CONNECTIVITY_4,
};

static DESCRIPTOR: Shared<dmrp_descriptor> = Shared(dmrp_descriptor {
    struct_size: std::mem::size_of::<dmrp_descriptor>() as u32,
    kind: DMRP_KIND_GLOBAL_PLANNER,
    id: text(ID),
    name: text(b"Prioritized planning in Rust\0"),
    version: text(b"0.1.0\0"),
    vendor: text(b"Example\0"),
    license: text(b"MIT\0"),
    url: std::ptr::null(),
    manual_url: std::ptr::null(),
    summary: text(b"robots plan one after the other, around the paths of those before them\0"),
    source: text(b"Erdmann, Lozano-Perez: On multiple moving objects, Algorithmica 2 (1987)\0"),
    features: std::ptr::null(),
    needed: std::ptr::null(),
    uses: std::ptr::null(),
    needed_count: 0,
    uses_count: 0,
    params: PARAMETERS.0.as_ptr(),
    param_count: 1,
    param_stride: std::mem::size_of::<dmrp_param_spec>() as u32,
    flags: 0,
    reserved: 0,
    traits: &TRAITS as *const dmrp_planner_traits as *const c_void,
});

static INTERFACE: dmrp_global_planner = dmrp_global_planner {
    struct_size: std::mem::size_of::<dmrp_global_planner>() as u32,
    reserved: 0,
    plan: Some(plan),
};

fn set_error(host: *const dmrp_host, text: &str) {
    let line = std::ffi::CString::new(text).unwrap_or_default();
    unsafe { ((*host).set_error.unwrap())(host, line.as_ptr()) }
}

// No panic crosses the border of the library.
fn guarded(host: *const dmrp_host, call: impl FnOnce() -> i32) -> i32 {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|_| {
        set_error(host, "panicked");
        DMRP_ERROR
    })
}

unsafe extern "C" fn plan(
    instance: *mut dmrp_instance,
    problem: *const dmrp_planning_problem,
    sink: *mut dmrp_plan_sink,
) -> i32 {
    let planner = &*(instance as *const Planner);
    guarded(planner.host, || planner.plan(&*problem, sink))
}

unsafe extern "C" fn start(_: *mut dmrp_instance, _: *const dmrp_start) -> i32 {
    DMRP_OK
}

unsafe extern "C" fn destroy(instance: *mut dmrp_instance) {
    drop(Box::from_raw(instance as *mut Planner));
}

unsafe extern "C" fn init(_: *const dmrp_entry, _: *const dmrp_host) -> i32 {
    std::panic::set_hook(Box::new(|_| {})); // the text goes to set_error(), not to standard error
    DMRP_OK
}

unsafe extern "C" fn deinit(_: *const dmrp_entry) {
    drop(std::panic::take_hook()); // it lies in this library, which may be unloaded now
}

unsafe extern "C" fn plugin_count(_: *const dmrp_entry) -> u32 {
    1
}

unsafe extern "C" fn descriptor(_: *const dmrp_entry, index: u32) -> *const dmrp_descriptor {
    if index == 0 {
        &DESCRIPTOR.0
    } else {
        std::ptr::null()
    }
}

unsafe extern "C" fn create(
    _: *const dmrp_entry,
    host: *const dmrp_host,
    id: *const c_char,
    params: *const dmrp_params,
    out: *mut dmrp_plugin,
) -> i32 {
    if CStr::from_ptr(id).to_bytes_with_nul() != ID {
        set_error(host, "no plugin of that id in this library");
        return DMRP_ERROR;
    }
    let orders = at((*params).values, (*params).stride, 0).integer;
    (*out).self_ = Box::into_raw(Box::new(Planner { host, orders })) as *mut dmrp_instance;
    (*out).table = &INTERFACE as *const dmrp_global_planner as *const c_void;
    (*out).start = Some(start);
    (*out).destroy = Some(destroy);
    DMRP_OK
}

#[no_mangle]
#[allow(non_upper_case_globals)]
pub static dmrp_entry_v1: dmrp_entry = dmrp_entry {
    struct_size: std::mem::size_of::<dmrp_entry>() as u32,
    abi_minor: DMRP_ABI_MINOR as u32,
    min_host_minor: DMRP_ABI_MINOR as u32,
    abi_draft: DMRP_ABI_DRAFT as u32,
    init: Some(init),
    deinit: Some(deinit),
    plugin_count: Some(plugin_count),
    descriptor: Some(descriptor),
    create: Some(create),
};

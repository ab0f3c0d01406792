// SPDX-License-Identifier: MIT
// A local controller whose algorithm is Python: the library embeds CPython and calls the class Policy of policy.py, which
// lies beside it. One object of Policy drives one robot. README.md says what Policy gets.
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <dlfcn.h>

#include <dmrp/plugin.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// An owned reference. Used with the interpreter's lock held.
struct Release {
  void operator()(PyObject* object) const { Py_DECREF(object); }
};
using Object = std::unique_ptr<PyObject, Release>;

// The interpreter's lock: calls may come from any thread.
class Lock {
 public:
  Lock() : state_(PyGILState_Ensure()) {}
  ~Lock() { PyGILState_Release(state_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  PyGILState_STATE state_;
};

// The pending exception as "ValueError: text".
std::string python_error() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  const Object owned_type(type), owned_value(value), owned_trace(trace);
  const Object text(value != nullptr ? PyObject_Str(value) : nullptr);
  const char* line = text ? PyUnicode_AsUTF8(text.get()) : nullptr;
  PyErr_Clear();
  const std::string name = type != nullptr ? reinterpret_cast<PyTypeObject*>(type)->tp_name : "Python error";
  return name + ": " + (line != nullptr ? line : "no text");
}

Object checked(PyObject* result) {
  if (result == nullptr) throw std::runtime_error("policy.py: " + python_error());
  return Object(result);
}

// A copy of the numbers as bytes, for numpy.frombuffer().
Object bytes_of(const std::vector<double>& numbers) {
  return checked(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(numbers.data()),
                                           static_cast<Py_ssize_t>(numbers.size() * sizeof(double))));
}

// numpy's libraries do not link libpython, so its symbols must be there for all.
void show_python_to_extension_modules() {
  Dl_info python{};
  if (dladdr(reinterpret_cast<const void*>(&Py_IsInitialized), &python) == 0 ||
      dlopen(python.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD) == nullptr)
    throw std::runtime_error("libpython cannot be made visible to its modules");
}

// Isolated: no variable of the environment, no signal handler, no change of the locale. A fixed seed for hashes, so that
// sets of texts have the same order in every process.
void start_interpreter() {
  PyPreConfig before;
  PyPreConfig_InitIsolatedConfig(&before);
  before.utf8_mode = 1;
  if (PyStatus_Exception(Py_PreInitialize(&before))) throw std::runtime_error("Python cannot start");
  PyConfig config;
  PyConfig_InitIsolatedConfig(&config);
  config.use_hash_seed = 1;
  config.hash_seed = 0;
  config.write_bytecode = 0;
  PyConfig_SetBytesString(&config, &config.program_name, PYTHON_PROGRAM);  // where the interpreter's modules are
  const PyStatus status = Py_InitializeFromConfig(&config);
  PyConfig_Clear(&config);
  if (PyStatus_Exception(status)) throw std::runtime_error(std::string("Python cannot start: ") + status.err_msg);
}

class PythonController final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.python_controller", "Policy in Python", "0.1.0")
        .vendor("Example")
        .license("MIT")
        .summary("asks the class Policy of policy.py, beside the library, for commands");
  }

  // Once for the library: numpy cannot be loaded twice, so the interpreter stays until the process ends.
  static void load(const dmrp::Host& host) {
    if (Py_IsInitialized() == 0) {
      show_python_to_extension_modules();
      start_interpreter();
      PyEval_SaveThread();  // gives the lock back
    }
    const Lock lock;
    const std::string library = host.library_path();
    const Object folder = checked(PyUnicode_FromString(library.substr(0, library.rfind('/')).c_str()));
    if (PyList_Insert(PySys_GetObject("path"), 0, folder.get()) != 0) throw std::runtime_error(python_error());
    const Object module = checked(PyImport_ImportModule("policy"));
    policy_class_ = checked(PyObject_GetAttrString(module.get(), "Policy")).release();
  }

  ~PythonController() override { forget_policy(); }

  dmrp::Status start(const dmrp::Start& start) override {
    forget_policy();
    const Lock lock;
    policy_ = checked(PyObject_CallFunction(policy_class_, "iK", start.robot, start.seed)).release();
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t /*revision*/) override {
    std::vector<double> numbers;
    for (const dmrp::Waypoint& w : path) numbers.insert(numbers.end(), {w.x, w.y, w.theta, dmrp::seconds(w.t_ns)});
    const Lock lock;
    checked(PyObject_CallMethod(policy_, "set_path", "O", bytes_of(numbers).get()));
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    const std::vector<double> state = {now.pose.x,
                                       now.pose.y,
                                       now.pose.theta,
                                       now.velocity.v_x,
                                       now.velocity.v_y,
                                       now.velocity.omega,
                                       now.goal.pose.x,
                                       now.goal.pose.y,
                                       now.goal.pose.theta,
                                       now.goal.tolerance_m,
                                       now.progress_m,
                                       now.limits.v_max,
                                       now.limits.omega_max,
                                       now.limits.a_max,
                                       now.limits.alpha_max,
                                       now.footprint.radius_m,
                                       dmrp::seconds(now.dt_ns)};
    std::vector<double> agents;
    for (const dmrp::Agent& other : now.agents)
      agents.insert(agents.end(), {static_cast<double>(other.kind), other.pose.x, other.pose.y, other.velocity.x,
                                   other.velocity.y, other.radius_m});
    const Lock lock;
    const Object answer =
        checked(PyObject_CallMethod(policy_, "step", "OO", bytes_of(state).get(), bytes_of(agents).get()));
    if (answer.get() == Py_None) return dmrp::Status::no_solution;  // the host brakes
    if (!PyArg_ParseTuple(answer.get(), "ddd:step() of Policy", &command.v_x, &command.v_y, &command.omega))
      throw std::runtime_error("policy.py: " + python_error());
    return dmrp::Status::ok;
  }

 private:
  void forget_policy() {
    if (policy_ == nullptr) return;
    const Lock lock;
    Py_DECREF(policy_);
    policy_ = nullptr;
  }

  static PyObject* policy_class_;
  PyObject* policy_ = nullptr;  // owned
};

PyObject* PythonController::policy_class_ = nullptr;

}  // namespace

DMRP_PLUGINS(PythonController)

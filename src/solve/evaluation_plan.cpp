#include "heerk_rotor/solve/evaluation_plan.hpp"

#include <algorithm>
#include <random>
#include <set>

#include "heerk_rotor/solve/strong_components.hpp"

namespace heerk_rotor {
namespace {

/// Entry-level gradient structure of one component: reads[i] lists the local entries that entry i depends on.
struct EntryGraph {
  std::vector<Index> entries;              // local -> y entry
  std::vector<Index> port;                 // local -> position in the component
  std::vector<std::vector<Index>> reads;   // local -> local
};

/// Differences every entry of the component at (t, x, w) and at perturbed points. An entry counts as read when the
/// result changes in any bit at any probe, so that an accidental zero at one state is not taken for a structural one.
EntryGraph probe(CoupledSystem& system, const std::vector<Index>& component, double t, const Vector& x0, const Vector& w) {
  constexpr int kProbes = 4;
  EntryGraph graph;
  std::vector<double> nominal;
  for (std::size_t c = 0; c < component.size(); ++c) {
    const CoupledSystem::Output& output = system.outputs()[component[c]];
    for (Index i = 0; i < output.size; ++i) {
      graph.entries.push_back(output.begin + i);
      graph.port.push_back(static_cast<Index>(c));
      nominal.push_back(output.nominal);
    }
  }
  const auto n = graph.entries.size();
  std::vector<std::set<Index>> reads(n);

  std::mt19937 random(20);  // fixed: the plan must not differ from run to run
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vector x = x0, u = Vector::Zero(system.inputSize()), y = Vector::Zero(system.outputSize());
  Vector base = y, moved = y;
  const auto evaluate = [&](Vector& g) {
    for (const Index port : component) {
      const CoupledSystem::Output& output = system.outputs()[port];
      for (const Index input : output.feedthrough) system.gather(input, y, w, u);
      system.evalOutput(port, t, x, u, g.data() + output.begin);
    }
  };
  for (int k = 0; k < kProbes; ++k) {
    for (Index i = 0; i < y.size(); ++i) y[i] = 0.0;
    for (const CoupledSystem::Output& output : system.outputs())
      for (Index i = 0; i < output.size; ++i) y[output.begin + i] = output.nominal * unit(random);
    if (k > 0)
      for (Index i = 0; i < x.size(); ++i) x[i] = x0[i] + 0.01 * (1.0 + std::abs(x0[i])) * unit(random);
    // Outputs outside the component take the values this state gives them, as far as they are explicit.
    for (Index port = 0; port < static_cast<Index>(system.outputs().size()); ++port) {
      const CoupledSystem::Output& output = system.outputs()[port];
      if (std::find(component.begin(), component.end(), port) == component.end() && output.feedthrough.empty())
        system.evalOutput(port, t, x, u, y.data() + output.begin);
    }
    evaluate(base);
    for (std::size_t j = 0; j < n; ++j) {
      const double kept = y[graph.entries[j]];
      y[graph.entries[j]] = kept + 1e-3 * nominal[j];
      evaluate(moved);
      y[graph.entries[j]] = kept;
      for (std::size_t i = 0; i < n; ++i)
        if (!(moved[graph.entries[i]] == base[graph.entries[i]])) reads[i].insert(static_cast<Index>(j));
    }
  }
  for (const auto& set : reads) graph.reads.emplace_back(set.begin(), set.end());
  return graph;
}

/// Entries from which `start` can be reached along `edges` (start included).
std::vector<char> closure(const std::vector<std::vector<Index>>& edges, const std::vector<char>& start) {
  std::vector<char> reached = start;
  std::vector<Index> todo;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (start[i]) todo.push_back(static_cast<Index>(i));
  while (!todo.empty()) {
    const Index v = todo.back();
    todo.pop_back();
    for (const Index w : edges[v])
      if (!reached[w]) {
        reached[w] = 1;
        todo.push_back(w);
      }
  }
  return reached;
}

/// Ports in an order that makes all `wanted` entries known, given `known`; greedy, most new entries first.
std::vector<Index> order(const EntryGraph& graph, const std::vector<Index>& component, const std::vector<char>& wanted, std::vector<char>& known) {
  std::vector<Index> result;
  for (;;) {
    std::vector<Index> ready(component.size(), 0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (wanted[i] && !known[i] && std::all_of(graph.reads[i].begin(), graph.reads[i].end(), [&](Index j) { return known[j]; })) ++ready[graph.port[i]];
    const auto best = std::max_element(ready.begin(), ready.end());
    if (best == ready.end() || *best == 0) return result;
    const Index port = best - ready.begin();
    result.push_back(component[port]);
    std::vector<char> now = known;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (graph.port[i] == port && wanted[i] && !known[i] && std::all_of(graph.reads[i].begin(), graph.reads[i].end(), [&](Index j) { return known[j]; })) now[i] = 1;
    known = now;
  }
}

/// Greedy colouring of columns that share no row (Curtis, Powell & Reid 1974).
void colourColumns(LoopPlan& plan) {
  const auto n = static_cast<std::size_t>(plan.gradient.size);
  plan.colour.assign(n, -1);
  plan.colours = 0;
  std::vector<std::vector<char>> taken;  // colour -> rows in use
  for (std::size_t j = 0; j < n; ++j) {
    Index c = 0;
    const auto collides = [&](Index colour) {
      for (Index p = plan.gradient.start[j]; p < plan.gradient.start[j + 1]; ++p)
        if (taken[colour][plan.gradient.rows[p]]) return true;
      return false;
    };
    while (c < plan.colours && collides(c)) ++c;
    if (c == plan.colours) {
      taken.emplace_back(n, char{0});
      ++plan.colours;
    }
    for (Index p = plan.gradient.start[j]; p < plan.gradient.start[j + 1]; ++p) taken[c][plan.gradient.rows[p]] = 1;
    plan.colour[j] = c;
  }
}

LoopPlan planLoop(const EntryGraph& graph, const std::vector<Index>& component, bool prune) {
  const auto n = graph.entries.size();
  LoopPlan plan;
  plan.outputs = component;

  // Unknown: on a cycle, or on a path from one cycle to another.
  std::vector<char> cyclic(n, prune ? 0 : 1);
  if (prune) {
    for (const auto& scc : strongComponents(graph.reads)) {
      const bool self = std::binary_search(graph.reads[scc[0]].begin(), graph.reads[scc[0]].end(), scc[0]);
      if (scc.size() > 1 || self)
        for (const Index i : scc) cyclic[i] = 1;
    }
  }
  std::vector<std::vector<Index>> read_by(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const Index j : graph.reads[i]) read_by[j].push_back(static_cast<Index>(i));
  const std::vector<char> feeds = closure(graph.reads, cyclic), follows = closure(read_by, cyclic);
  std::vector<char> unknown(n), first(n), last(n);
  for (std::size_t i = 0; i < n; ++i) {
    unknown[i] = feeds[i] && follows[i];
    first[i] = !follows[i];
    last[i] = follows[i] && !unknown[i];
  }

  // Whatever does not follow from the loop is known before it, the rest after it.
  std::vector<char> known(n, 0);
  plan.before = order(graph, component, first, known);
  std::vector<Index> local(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    if (!unknown[i]) continue;
    known[i] = 1;
    local[i] = static_cast<Index>(plan.unknowns.size());
    plan.unknowns.push_back(graph.entries[i]);
    const Index port = component[graph.port[i]];
    if (plan.core.empty() || plan.core.back() != port) plan.core.push_back(port);
  }
  plan.after = order(graph, component, last, known);

  plan.gradient.size = static_cast<Index>(plan.unknowns.size());
  plan.gradient.start.push_back(0);
  for (std::size_t j = 0; j < n; ++j) {
    if (!unknown[j]) continue;
    std::set<Index> rows{local[j]};
    for (const Index i : read_by[j])
      if (unknown[i]) rows.insert(local[i]);
    plan.gradient.rows.insert(plan.gradient.rows.end(), rows.begin(), rows.end());
    plan.gradient.start.push_back(static_cast<Index>(plan.gradient.rows.size()));
  }
  colourColumns(plan);
  return plan;
}

/// What the ports of a loop read of each other.
void findInnerInputs(const CoupledSystem& system, LoopPlan& plan) {
  const auto contains = [](const std::vector<Index>& list, Index value) { return std::find(list.begin(), list.end(), value) != list.end(); };
  const auto fedBy = [&](Index input, const std::vector<Index>& ports) {
    const auto& sources = system.inputs()[input].sources;
    return std::any_of(sources.begin(), sources.end(), [&](Index source) { return contains(ports, source); });
  };
  const auto readOf = [&](Index port, const std::vector<Index>& ports) {
    std::vector<Index> inputs;
    for (const Index input : system.outputs()[port].feedthrough)
      if (fedBy(input, ports)) inputs.push_back(input);
    return inputs;
  };
  const auto append = [&](const std::vector<Index>& inputs, std::vector<Index>& to) {
    for (const Index input : inputs)
      if (!contains(to, input)) to.push_back(input);
  };
  for (const Index port : plan.outputs) {
    append(readOf(port, plan.outputs), plan.inner_inputs);
    if (contains(plan.core, port)) append(readOf(port, plan.core), plan.core_inputs);
    const CoupledSystem::Output& output = system.outputs()[port];
    const auto iterated = std::count_if(plan.unknowns.begin(), plan.unknowns.end(), [&](Index e) { return e >= output.begin && e < output.begin + output.size; });
    if (iterated < output.size || !readOf(port, plan.after).empty()) plan.always_checked.push_back(port);
  }
  for (const Index port : plan.before) plan.before_inputs.push_back(readOf(port, plan.outputs));
  for (const Index port : plan.after) plan.after_inputs.push_back(readOf(port, plan.outputs));
}

/// Without pruning every entry may depend on every entry that its port can reach.
EntryGraph coarse(const CoupledSystem& system, const std::vector<Index>& component, EntryGraph graph) {
  const auto n = graph.entries.size();
  for (std::size_t i = 0; i < n; ++i) {
    graph.reads[i].clear();
    for (std::size_t j = 0; j < n; ++j) {
      const auto& inputs = system.outputs()[component[graph.port[i]]].feedthrough;
      const bool reaches = std::any_of(inputs.begin(), inputs.end(), [&](Index input) {
        const auto& sources = system.inputs()[input].sources;
        return std::find(sources.begin(), sources.end(), component[graph.port[j]]) != sources.end();
      });
      if (reaches) graph.reads[i].push_back(static_cast<Index>(j));
    }
  }
  return graph;
}

/// Components in an order of dependency in which ports of one subsystem stand together as far as possible, so that one call can evaluate them: next is a
/// component of the subsystem before, otherwise of the one that has the fewest ports waiting for others.
std::vector<std::vector<Index>> bySubsystem(std::vector<std::vector<Index>> components, const std::vector<std::vector<Index>>& depends, const CoupledSystem& system) {
  std::vector<std::size_t> component_of(depends.size());
  for (std::size_t c = 0; c < components.size(); ++c)
    for (const Index port : components[c]) component_of[static_cast<std::size_t>(port)] = c;
  const auto ownerOf = [&](std::size_t c) { return system.outputs()[static_cast<std::size_t>(components[c][0])].subsystem; };
  std::vector<char> done(components.size(), 0);
  const auto isReady = [&](std::size_t c) {
    for (const Index port : components[c])
      for (const Index source : depends[static_cast<std::size_t>(port)])
        if (const std::size_t other = component_of[static_cast<std::size_t>(source)]; other != c && !done[other]) return false;
    return true;
  };
  std::vector<std::vector<Index>> order;
  Index last = -1;
  while (order.size() < components.size()) {
    std::vector<char> ready(components.size(), 0);
    std::vector<int> waiting(system.subsystems().size(), 0);
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (done[c]) continue;
      ready[c] = isReady(c);
      if (!ready[c]) ++waiting[static_cast<std::size_t>(ownerOf(c))];
    }
    std::size_t best = components.size();
    int fewest = 0;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (!ready[c]) continue;
      const int of_owner = ownerOf(c) == last ? -1 : waiting[static_cast<std::size_t>(ownerOf(c))];
      if (best < components.size() && of_owner >= fewest) continue;
      best = c;
      fewest = of_owner;
    }
    done[best] = 1;
    last = ownerOf(best);
    order.push_back(components[best]);
  }
  return order;
}

}  // namespace

EvaluationPlan planEvaluation(CoupledSystem& system, double t, const Vector& x, const Vector& w) {
  const auto& outputs = system.outputs();
  const auto& inputs = system.inputs();
  std::vector<std::vector<Index>> depends(outputs.size());
  for (std::size_t o = 0; o < outputs.size(); ++o)
    for (const Index input : outputs[o].feedthrough)
      depends[o].insert(depends[o].end(), inputs[input].sources.begin(), inputs[input].sources.end());
  const auto components = bySubsystem(strongComponents(depends), depends, system);
  const auto isLoop = [&](const std::vector<Index>& component) {
    return component.size() > 1 || std::find(depends[component[0]].begin(), depends[component[0]].end(), component[0]) != depends[component[0]].end();
  };

  const auto reachesState = [&](std::size_t input) { return system.subsystems()[inputs[input].subsystem].x_size > 0 && !inputs[input].only_for_outputs; };

  // Needed at every stage: what reaches a model with states, and every loop.
  EvaluationPlan plan;
  std::vector<char> needed(outputs.size(), 0);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!reachesState(i)) continue;
    for (const Index source : inputs[i].sources) needed[source] = 1;
  }
  for (const auto& component : components)
    if (isLoop(component))
      for (const Index o : component) needed[o] = 1;
  needed = closure(depends, needed);

  // An input is final once the ports that feed it are, so each is gathered once, by the first port that reads it;
  // only what a loop feeds to itself is gathered again while it iterates. Constants stay as they are.
  std::vector<char> gathered(inputs.size(), 0);
  for (std::size_t i = 0; i < inputs.size(); ++i) gathered[i] = inputs[i].sources.empty() && inputs[i].command < 0;
  const auto newInputs = [&](const std::vector<Index>& ports) {
    std::vector<Index> result;
    for (const Index port : ports)
      for (const Index input : outputs[port].feedthrough)
        if (!gathered[input]) {
          gathered[input] = 1;
          result.push_back(input);
        }
    return result;
  };
  for (const auto& component : components) {
    if (!needed[component[0]]) continue;
    if (!isLoop(component)) {
      plan.stage.push_back({newInputs(component), component[0], -1});
      continue;
    }
    std::vector<Index> ports = component;
    std::sort(ports.begin(), ports.end());
    const EntryGraph graph = probe(system, ports, t, x, w);
    plan.stage.push_back({newInputs(ports), -1, static_cast<Index>(plan.pruned.size())});
    plan.pruned.push_back(planLoop(graph, ports, true));
    plan.full.push_back(planLoop(coarse(system, ports, graph), ports, false));
    findInnerInputs(system, plan.pruned.back());
    findInnerInputs(system, plan.full.back());
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (gathered[i] || !reachesState(i)) continue;
    gathered[i] = 1;
    plan.last_inputs.push_back(static_cast<Index>(i));
  }
  for (const auto& component : components)
    if (!needed[component[0]]) plan.observed.push_back({newInputs(component), component[0], -1});
  return plan;
}

std::vector<char> neededInStages(const EvaluationPlan& plan, const CoupledSystem& system) {
  std::vector<char> needed(system.outputs().size(), 0);
  for (const EvaluationPlan::Item& item : plan.stage) {
    if (item.output >= 0) needed[item.output] = 1;
    else
      for (const Index output : plan.full[item.loop].outputs) needed[output] = 1;
  }
  return needed;
}

}  // namespace heerk_rotor

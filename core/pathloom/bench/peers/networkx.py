"""networkx: A* over the graph of the grid."""

from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve
from pathloom.bench.peers.grid_graph import octile, steps
from pathloom.paths.problem import PathProblem


class NetworkxAstar(Peer):
    """`astar_path` with the octile distance, on a graph built once for the map."""

    name = "networkx astar_path"
    distribution: ClassVar[str] = "networkx"
    about = "8 neighbours under the corner policy, octile heuristic; building the graph is told apart"
    draws: ClassVar[bool] = False

    def prepare(self, problem: PathProblem) -> Solve:
        import networkx as nx

        graph = nx.Graph()
        graph.add_nodes_from(around := steps(problem))
        graph.add_weighted_edges_from((a, b, octile(a, b)) for a, near in around.items() for b in near if a < b)

        def solve(*_: Any) -> Answer:
            try:
                return np.array(nx.astar_path(graph, *problem.ends, heuristic=octile))
            except nx.NetworkXNoPath:
                return None

        return solve

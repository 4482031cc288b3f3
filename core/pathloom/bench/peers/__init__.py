"""Peers: what one would take instead. Each is used as its own documentation does; none needs to be installed."""

from pathloom.bench.peer import Peer
from pathloom.bench.peers.deap import DeapPaths
from pathloom.bench.peers.mealpy import MealpyGa
from pathloom.bench.peers.networkx import NetworkxAstar
from pathloom.bench.peers.ompl import BITSTAR, INFORMED, RRT_CONNECT
from pathloom.bench.peers.pyastar2d import Pyastar2d
from pathloom.bench.peers.pygad import PygadGa
from pathloom.bench.peers.pymoo import PymooGa, PymooNsga2
from pathloom.bench.peers.pymoo_with_ours import PymooGaWithOurs, PymooNsga2WithOurs
from pathloom.bench.peers.scikit_image import RouteThroughArray

PEERS: dict[str, Peer] = {
    peer.name: peer
    for peer in (
        RouteThroughArray(), Pyastar2d(), NetworkxAstar(), RRT_CONNECT, BITSTAR, INFORMED,
        PymooGaWithOurs(), PymooNsga2WithOurs(), PymooGa(), PymooNsga2(), DeapPaths(), PygadGa(), MealpyGa(),
    )
}  # fmt: skip
"""All of them by name, in the order of the table."""

"""``pathloom policy``: local obstacle avoidance, learned, tried and driven."""

from importlib import import_module

import click

from pathloom.cli import Group

ELSEWHERE: dict[str, tuple[str, str]] = {
    "train": ("policy_train", "Train a policy on examples, and keep the model in a file."),
    "evaluate": ("policy_evaluate", "Measure how well policies predict what was right."),
    "drive": ("policy_drive", "Let policies drive along a path, around what the map does not show."),
}
"""Sub-commands: the module of each in this folder, and what it is for; ``command`` is in it."""


class Commands(Group):
    """The sub-commands, which are loaded when they are called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(ELSEWHERE)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in ELSEWHERE:
            return None
        return import_module(f"pathloom.cli.{ELSEWHERE[cmd_name][0]}").command  # type: ignore[no-any-return]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, help_) for name, (_, help_) in ELSEWHERE.items()])


@click.group("policy", cls=Commands)
def command() -> None:
    """Avoid obstacles locally: train, evaluate and drive policies that decide from 2, 4 or 24 distances."""

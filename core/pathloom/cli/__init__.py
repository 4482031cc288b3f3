"""The command line. Commands are loaded when they are called, so that ``--help`` is instant."""

import io
import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any

import click

COMMANDS = {
    "plan": "Plan one path and show how good it is.",
    "pareto": "Plan a front of trade-offs between objectives.",
    "compare": "Hold planners against each other.",
    "ablate": "Change one part of a planner at a time.",
    "tune": "Try values of a planner's parameters, and predict the best.",
    "study": "Show, resume and export what compare and ablate wrote.",
    "claims": "Measure again what the papers say.",
    "policy": "Avoid obstacles locally: train, evaluate, drive.",
    "maps": "List, show, check and make maps.",
    "studio": "Draw, drag and watch evolution in the browser.",
    "plugins": "List, show, cite, check and begin plugins.",
}
"""Each command's module in this folder, and what it is for."""

DONE, BAD_INPUT, NO_PATH, INTERRUPTED, DEFECT = 0, 2, 3, 130, 1


class Group(click.Group):
    """A group that shows its help when it is called alone, and says what an unknown command probably meant."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        if not args:
            click.echo(ctx.get_help())
            ctx.exit()
        return super().parse_args(ctx, args)

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        known = self.list_commands(ctx)
        if args and args[0] not in known and not args[0].startswith("-"):
            from pathloom.naming import closest

            raise click.UsageError(f"no command is called {args[0]!r}; {closest(args[0], known)}", ctx)
        return super().resolve_command(ctx, args)


class Commands(Group):
    """The group of all commands: it knows them by name and imports one when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        return import_module(f"pathloom.cli.{cmd_name}").command  # type: ignore[no-any-return]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="pathloom")
def pathloom() -> None:
    """Evolutionary path planning on occupancy grids, held against the exact optimum.

    Exit codes: 0 done, 2 bad input, 3 no path, 130 interrupted, 1 a defect of pathloom.
    """


def main() -> None:
    """Run the command line and exit with its code: one line for whatever goes wrong."""
    from pathloom.errors import PathloomError

    _make_output_safe()
    output = sys.stdout
    try:
        with _warnings_in_one_line():
            code = pathloom.main(prog_name="pathloom", standalone_mode=False)
        sys.stdout.flush()
    except PathloomError as error:
        code = _say(str(error), BAD_INPUT)
    except click.ClickException as error:
        command = error.ctx.command_path if isinstance(error, click.UsageError) and error.ctx else ""
        where = f"{command.removeprefix('pathloom').strip()}: " if " " in command else ""
        code = _say(where + error.format_message(), BAD_INPUT)
    except (KeyboardInterrupt, click.Abort):
        code = _say("interrupted", INTERRUPTED)
    except SystemExit:
        if sys.stdout is output:
            raise
        code = DONE  # a pipe was closed: click has put a silent stream in the place of our output
    except BrokenPipeError:  # whoever read our output has seen enough
        _abandon_output()
        code = DONE
    except OSError as error:
        if error.filename is None:
            _abandon_output()
        code = _say(f"{error.filename or 'output'}: {error.strerror or error}", BAD_INPUT)
    except MemoryError as error:
        code = _say(f"found too little memory: {error or 'none is left'}; take a smaller map or population", BAD_INPUT)
    except Exception as error:
        if isinstance(error.__cause__, KeyboardInterrupt):  # so a compiled kernel ends that is interrupted in its midst
            code = _say("interrupted", INTERRUPTED)
        elif os.environ.get("PATHLOOM_TRACEBACK"):
            raise
        else:
            shown = f"a defect, please report it: {type(error).__name__}: {error}"
            code = _say(f"{shown} (PATHLOOM_TRACEBACK=1 shows where)", DEFECT)
    sys.exit(code or DONE)


@contextmanager
def _warnings_in_one_line() -> Iterator[None]:
    """Say what is wrong with a plugin that works as any other message; other warnings are as they were."""
    from pathloom.errors import PluginWarning

    shown_before = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, PluginWarning):
            _say(str(message), DONE)
        else:
            shown_before(message, category, *where, **more)

    warnings.showwarning = show
    try:
        yield
    finally:
        warnings.showwarning = shown_before


def _make_output_safe() -> None:
    """Let printing fail neither for want of a stream, which may be closed, nor of a letter in its encoding."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115 - until the process ends
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")


def _abandon_output() -> None:
    """Let what is still to be printed go nowhere, so that the interpreter does not fail on it when it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _say(message: str, code: int) -> int:
    from pathloom.files import one_line

    print(one_line("pathloom: " + " ".join(message.split())), file=sys.stderr)
    return code

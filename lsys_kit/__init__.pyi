"""The public names, each with its home: what editors and type checkers read, and what the package loads on first use."""

from typing import Any

from lsys_kit.budget import limits as limits
from lsys_kit.classroom.catalogue import book_systems as book_systems
from lsys_kit.classroom.catalogue import cellwork_system as cellwork_system
from lsys_kit.classroom.catalogue import cellwork_systems as cellwork_systems
from lsys_kit.classroom.catalogue import map_system as map_system
from lsys_kit.classroom.catalogue import map_systems as map_systems
from lsys_kit.classroom.catalogue import system as system
from lsys_kit.classroom.catalogue import systems as systems
from lsys_kit.classroom.exercises.check import check as check
from lsys_kit.classroom.exercises.practice.practice import practice as practice
from lsys_kit.classroom.exercises.progress import progress as progress
from lsys_kit.classroom.exercises.progress import score as score
from lsys_kit.classroom.exercises.registry import exercises as exercises
from lsys_kit.classroom.lessons.predict import predict as predict
from lsys_kit.classroom.lessons.rule_finder import rule_finder as rule_finder
from lsys_kit.classroom.lessons.vote import vote as vote
from lsys_kit.classroom.lessons.worksheet import ask as ask
from lsys_kit.classroom.lessons.worksheet import worksheet as worksheet
from lsys_kit.classroom.link import link as link
from lsys_kit.classroom.link import linked as linked
from lsys_kit.classroom.live.notebook import open_class as open_class
from lsys_kit.classroom.panel.explorer import compare as compare
from lsys_kit.classroom.panel.explorer import explore as explore
from lsys_kit.classroom.variants import variants as variants
from lsys_kit.derivation.explain import explain as explain
from lsys_kit.derivation.growth.growth import growth as growth
from lsys_kit.derivation.petri.pnml import pnml as pnml
from lsys_kit.derivation.petri.stages import stages as stages
from lsys_kit.derivation.timed.continuity import continuity as continuity
from lsys_kit.derivation.timed.lineage import lineage as lineage
from lsys_kit.derivation.timed.timed import timed as timed
from lsys_kit.errors import LSystemError as LSystemError
from lsys_kit.errors import ModelFileError as ModelFileError
from lsys_kit.errors import ModelLimitError as ModelLimitError
from lsys_kit.errors import ModelNameError as ModelNameError
from lsys_kit.errors import ModelSyntaxError as ModelSyntaxError
from lsys_kit.errors import ModelValueError as ModelValueError
from lsys_kit.experiments.closing import closing_angles as closing_angles
from lsys_kit.experiments.distances import distances as distances
from lsys_kit.experiments.life_spans import life_spans as life_spans
from lsys_kit.experiments.plot import plot as plot
from lsys_kit.experiments.runs import ensemble as ensemble
from lsys_kit.experiments.runs import sweep as sweep
from lsys_kit.experiments.table import Table as Table
from lsys_kit.experiments.totals import Total as Total
from lsys_kit.experiments.totals import total as total
from lsys_kit.geometry.inference.infer import infer as infer
from lsys_kit.notation.dialects.cellwork.dialect import read_cellwork as read_cellwork
from lsys_kit.notation.dialects.cpfg.surface_files import with_surface as with_surface
from lsys_kit.notation.dialects.map.dialect import read_map as read_map
from lsys_kit.notation.read import read as read
from lsys_kit.notation.write import write as write
from lsys_kit.pictures.draw import draw as draw
from lsys_kit.pictures.draw import figure as figure
from lsys_kit.pictures.films import animate as animate
from lsys_kit.pictures.hierarchy import draw_hierarchy as draw_hierarchy
from lsys_kit.pictures.qr_codes import qr_code as qr_code
from lsys_kit.translation import language as language
from lsys_kit.worlds.derive import derive as derive

__all__: list[str]

def load_ipython_extension(shell: Any) -> None: ...

"""Strandlab in Python: form a mat of strands, press it, glue it, test it.

    import strandlab

    case = strandlab.Case.ready("osb")
    case.mat.length_mm = 30
    result = strandlab.run(case)
    print(result.moduli)

Lengths are in mm, stresses and moduli in MPa, densities in kg/m3, angles in degrees; names of columns and keys carry their units.
Nothing is written to disk unless a folder or a file is named. Bad input raises InputError, a simulation that cannot go on RunError.
Tables are pandas DataFrames where pandas is installed, else dictionaries of arrays by column.
"""

from ._core import InputError, RunError, __version__
from ._case import Case, Section, ready_cases
from ._panel import Panel, Strand
from ._run import (BondLines, FolderRun, HotPress, Mat, Pressed, Run, Tested, bondline, bondline_example, cure, form, hotpress, open_run, press,
                   profile, run, test, theory)
from ._plate import Plate, TestedPlate, plate
from ._study import Study, open_study, study

__all__ = ["BondLines", "Case", "FolderRun", "HotPress", "InputError", "Mat", "Panel", "Plate", "Pressed", "Run", "RunError", "Section", "Strand",
           "Study", "Tested", "TestedPlate", "__version__", "bondline", "bondline_example", "cure", "form", "hotpress", "open_run", "open_study",
           "plate", "press", "profile", "ready_cases", "run", "study", "test", "theory"]

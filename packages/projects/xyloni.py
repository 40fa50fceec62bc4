# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from constraints/xyloni/board.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Xyloni with Efinity:
#   make verilog TOP=board_xyloni_ppmc104
#   python3 packages/projects/xyloni.py
import os
import subprocess
import sys
from html import escape
from pathlib import Path

root = Path(__file__).resolve().parents[2]
parts = "ppmc104".split()
on = os.environ.get("PART", parts[0])
if on not in parts:
    sys.exit(f"PART={on}: this board has {' '.join(parts)}")
top = "board_xyloni_" + on.replace("-", "_")
plain, pins = root / f"build/verilog/{top}.v", root / "constraints" / "xyloni" / on
if not plain.is_file():
    sys.exit(f"{plain}: not written; run `make verilog TOP={top}` in {root}")
if "EFINITY_HOME" not in os.environ or "EFXPT_HOME" not in os.environ:
    sys.exit("EFINITY_HOME or EFXPT_HOME: not set; source bin/setup.sh of Efinity")
work = root / "build" / "efinity" / top
work.mkdir(parents=True, exist_ok=True)
os.chdir(work)
sys.path.append(os.environ["EFXPT_HOME"] + "/bin")
from api_service.design import DesignAPI

Path(f"{top}.xml").write_text(f"""<?xml version="1.0" encoding="UTF-8"?>
<efx:project xmlns:efx="http://www.efinixinc.com/enf_proj" name="{top}" location="{escape(str(work))}">
  <efx:device_info>
    <efx:family name="Trion"/>
    <efx:device name="T8F81"/>
    <efx:timing_model name="C2"/>
  </efx:device_info>
  <efx:design_info def_veri_version="verilog_2k" def_vhdl_version="vhdl_2008">
    <efx:top_module name="{top}"/>
    <efx:design_file name="{escape(str(plain))}" version="default" library="default"/>
    <efx:top_vhdl_arch name=""/>
  </efx:design_info>
  <efx:constraint_info>
    <efx:sdc_file name="{escape(str(pins / 'clocks.sdc'))}"/>
    <efx:inter_file name=""/>
  </efx:constraint_info>
  <efx:sim_info/>
  <efx:misc_info/>
  <efx:ip_info/>
  <efx:synthesis tool_name="efx_map">
    <efx:param name="work_dir" value="work_syn" value_type="e_string"/>
    <efx:param name="mode" value="speed" value_type="e_option"/>
  </efx:synthesis>
  <efx:place_and_route tool_name="efx_pnr">
    <efx:param name="work_dir" value="work_pnr" value_type="e_string"/>
  </efx:place_and_route>
  <efx:bitstream_generation tool_name="efx_pgm">
    <efx:param name="mode" value="active" value_type="e_string"/>
    <efx:param name="width" value="1" value_type="e_string"/>
  </efx:bitstream_generation>
</efx:project>
""", encoding="utf-8")
design = DesignAPI(False)
design.create(top, "T8F81", str(work), overwrite=True)
imported = design.import_design(str(pins / "pins.isf"))
if isinstance(imported, tuple) and not imported[0]:
    sys.exit(f"{pins}/pins.isf: Efinity rejects it: {imported[1]}")
design.generate(enable_bitstream=False)
design.save()
run = Path(os.environ["EFINITY_HOME"]) / "scripts" / "efx_run.py"
sys.exit(subprocess.run([sys.executable, run, "--prj", f"{top}.xml", "--flow", "compile"]).returncode)

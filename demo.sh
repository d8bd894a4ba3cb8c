#!/usr/bin/env bash
# Sets up, builds, and sets two contact laws against each other and the analytic answer on the incline.
set -euo pipefail
cd "$(dirname "$0")"
source cmake/setup.sh

install_missing_packages
build_preset release apps/all contact_models/all plugins/all  # no tests
build/release/bin/talus compare scenes/incline.json --vary /contact/model=overlap_area,vertex_edge \
  --reference scenes/reference/incline_overlap_area.csv --out out/incline --overwrite
echo "Open out/incline/report.html. Beside it are compare.csv (curves), compare.json (deviations), and a folder per law."

#!/usr/bin/env bash
# run.sh packages            installs the scripts' packages as package-lock.json has them, if they are not there yet
# run.sh bundle <folder>     types, lint, units; and that report/web/dist is what its sources give
# run.sh pages <folder>      the tests in the browser; their pictures are left in <folder>/pictures
# Exit code 77: skipped, with the reason. SPALL_BINARY and SPALL_MAKE_PAGES name the programs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export SPALL_SOURCE=${here%/tests/browser} PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1
web=$SPALL_SOURCE/report/web
skip() { echo "skipped: $*"; exit 77; }
command -v node >/dev/null && command -v npm >/dev/null || skip "node or npm is not installed (Debian: nodejs npm)"
(($(node -p 'process.versions.node.split(".")[0]') >= 18)) || skip "node $(node --version) is older than 18"

case $1 in
  packages)
    # One at a time, though several builds may share the folder.
    exec 9>"$web/.packages.lock"
    flock 9
    [[ $web/node_modules/.package-lock.json -nt $web/package-lock.json ]] && exit 0
    cd "$web"
    npm ci --silent --no-audit --no-fund --prefer-offline
    touch node_modules/.package-lock.json
    ;;
  bundle)
    cd "$web"
    npm run --silent check
    npm run --silent test
    rm -rf "$2" && node build.mjs "$2"
    diff -r "$2" dist >/dev/null || { echo "report/web/dist is not what its sources give: cd report/web && npm run build"; exit 1; }
    ;;
  pages)
    chromium=
    for name in chromium chromium-browser google-chrome; do
      chromium=$(command -v "$name") && break
    done
    [[ $chromium ]] || skip "no chromium is installed"
    export SPALL_CHROMIUM=$chromium SPALL_BROWSER_OUT=$2 NODE_PATH=$web/node_modules
    cd "$here"
    node "$web/node_modules/@playwright/test/cli.js" test --config playwright.config.ts "${@:3}"
    ;;
esac

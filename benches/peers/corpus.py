"""Renders all scene files below some folders, small and with few samples, and prints what becomes of each: a table of the exit code, the seconds of
processor time, the numbers of warnings, the mean of the image, and the first error or the hint; then how many were refused, took over 5 s, or
are black without a hint. The files are those that people have published: fetch them yourself, and do not commit them.

    python3 benches/peers/corpus.py target/release/etendue FOLDER...

With --environment FILE, scenes are lit by that sky, too.
"""

import argparse
import collections
import json
import os
import re
import resource
import subprocess
import sys
import tempfile

ENDS = ('.pbrt', '.gltf', '.glb')


def scenes(folders):
    """Scene files: those of pbrt only if they have a camera of their own and a world."""
    for folder in folders:
        for root, _, names in sorted(os.walk(folder)):
            for name in sorted(names):
                path = os.path.join(root, name)
                if not name.endswith(ENDS):
                    continue
                if name.endswith('.pbrt'):
                    with open(path, encoding='utf-8', errors='replace') as file:
                        if 'WorldBegin' not in file.read(1 << 20):
                            continue
                yield path


def spent():
    """Processor time of the programs that have ended, which others on the machine do not lengthen."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(options, path, output):
    """Exit code, seconds of processor time, the object that was printed, and the lines of messages."""
    command = [options.etendue, 'render', path, '--size', '64x48', '--spp', '4', '--threads', '1', '--json', '-o', output]
    if options.environment:
        command += ['--environment', options.environment]
    start = spent()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=options.timeout)
    except subprocess.TimeoutExpired:
        return None, spent() - start, {}, [f'took over {options.timeout} s']
    said = json.loads(done.stdout) if done.returncode == 0 else {}
    return done.returncode, spent() - start, said, done.stderr.splitlines()


def reason(error):
    """Whose reasons these are to refuse a file."""
    for text, why in (('cannot read', 'a file is absent'), ('pointer', 'a file is a pointer'), ('glTF of version', 'glTF 1.0'),
                      ('binary glTF file of version', 'glTF 1.0'), ('requires the extension', 'a required extension')):
        if text in error:
            return why
    return 'another reason'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('etendue', help='the program')
    parser.add_argument('folders', nargs='+')
    parser.add_argument('--environment')
    parser.add_argument('--timeout', type=float, default=120)
    options = parser.parse_args()
    kinds, counts = collections.Counter(), collections.Counter()
    print('| file | code | s | warnings | mean | |\n|---|---|---|---|---|---|')
    with tempfile.TemporaryDirectory() as folder:
        for path in scenes(options.folders):
            code, seconds, said, lines = render(options, path, os.path.join(folder, 'image.exr'))
            warnings = [line for line in lines if line.startswith('warning:')]
            hints = [line for line in lines if line.startswith('hint:')]
            mean = sum(said.get('mean', [0.0])) / 3 if said else 0.0
            for line in warnings:
                kinds[re.sub(r'[0-9.]+|".*?"', '_', line.split(': ', 2)[-1])[:60]] += 1
            counts['files'] += 1
            last = (hints or [line for line in lines if not line.startswith('warning:')] or [''])[-1]
            # what follows the name of the file
            last = re.sub(r'/\S*/', '', last)
            if code == 2:
                counts['refused'] += 1
                counts[f'refused: {reason(last)}'] += 1
            counts['others'] += code not in (0, 2)
            counts['over 5 s'] += seconds > 5
            counts['with warnings'] += bool(warnings)
            counts['black'] += code == 0 and mean == 0.0
            counts['black without a hint'] += code == 0 and mean == 0.0 and not hints
            print(f'| {path} | {code} | {seconds:.1f} | {len(warnings)} | {mean:.4g} | {last[:120]} |', flush=True)
    print()
    for what, count in counts.items():
        print(f'{what}: {count}')
    for what, count in kinds.most_common(20):
        print(f'{count:5} {what}')
    sys.exit(1 if counts['others'] else 0)


if __name__ == '__main__':
    main()

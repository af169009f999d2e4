"""Where the sources refuse something, and the words they do it with: every `throw` and every call of a function whose
name begins with refuse. Literals alone count; what stands between them is the caller's."""

import bisect
import re

LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
SKIPPED = re.compile(r'//[^\n]*|/\*.*?\*/|\'(?:[^\'\\]|\\.)\'', re.S)
CALL = re.compile(r'\bthrow\s+([A-Z]\w*|std::\w+)\s*(?=[({])|\b(refuse\w*)\s*(?=\()')
DEFINITION = re.compile(r'void\s+(?:\w+::)?(refuse\w*)\s*\(|\bauto\s+(refuse\w*)\s*=\s*\[')
CLOSING = {'(': ')', '{': '}', '[': ']'}
# Of the inside: they never reach a caller, or have no words.
INTERNAL = {'Cancelled', 'Exhausted', 'TapeTooLong', 'Interrupted', 'Indefinite', 'std::bad_alloc'}


def without_comments(text):
    """Comments and characters blanked, so that every offset still holds. Literals are kept."""
    out, at = [], 0
    for match in re.finditer(f'{LITERAL.pattern}|{SKIPPED.pattern}', text, re.S):
        out.append(text[at:match.start()])
        kept = match.group().startswith('"')
        out.append(match.group() if kept else re.sub(r'[^\n]', ' ', match.group()))
        at = match.end()
    return ''.join(out) + text[at:]


def end_of(text, begin):
    """One past the bracket that closes the one at `begin`."""
    depth = []
    at = begin
    while at < len(text):
        literal = LITERAL.match(text, at)
        if literal:
            at = literal.end()
            continue
        if text[at] in CLOSING:
            depth.append(CLOSING[text[at]])
        elif depth and text[at] == depth[-1]:
            depth.pop()
            if not depth:
                return at + 1
        at += 1
    raise ValueError(f'unclosed bracket: {text[begin:begin + 80]}')


def pieces(literal):
    """What is said as it stands: between the braces of a format."""
    words = literal.encode().decode('unicode_escape').replace('{{', '\x01').replace('}}', '\x02')
    parts = [part.replace('\x01', '{').replace('\x02', '}').strip() for part in re.split(r'\{[^}]*\}', words)]
    return [part for part in parts if re.search(r'[A-Za-z]{2}', part)]


def words_in(code):
    """The literals that are always said, and those of which one is."""
    always, either = [], []
    code = re.sub(r'"\s*\n?\s*"', '', code)
    for match in LITERAL.finditer(code):
        before = re.sub(r'(std::string|\(|\s)+$', '', code[:match.start()])
        chosen = before.endswith('?') or (before.endswith(':') and not before.endswith('::'))
        if before.endswith(('==', '!=')) or re.match(r'\s*(\[|\)\s*\?)', code[match.end():]):
            continue  # Compared, or asked for: not said.
        (either if chosen else always).extend(pieces(match.group(1)))
    return always, either


class Site:
    def __init__(self, file, line, kind, code, always, either):
        self.file, self.line, self.kind, self.always, self.either = file, line, kind, always, either
        self.code = re.sub(r'\s+', ' ', code)

    def is_said_by(self, messages):
        said = [m for m in messages if all(piece in m for piece in self.always)]
        return bool(said) and all(any(piece in m for m in said) for piece in self.either)

    def __str__(self):
        return f'{self.file}:{self.line}: {self.code}'


def sites_in(file, text):
    text = without_comments(text)
    lines = [0] + [match.end() for match in re.finditer('\n', text)]
    helpers, declared = {}, set()
    for match in DEFINITION.finditer(text):
        name = match.group(1) or match.group(2)
        declared.add(match.start(1) if match.group(1) else match.start(2))
        body = re.compile(r'[{;]').search(text, end_of(text, text.index('[' if match.group(2) else '(', match.start())))
        if body and body.group() == '{':
            thrown = [(m.group(1), text[m.end():end_of(text, m.end())])
                      for m in CALL.finditer(text, body.start(), end_of(text, body.start())) if m.group(1)]
            if len(thrown) == 1:
                helpers[name] = (thrown[0][0], words_in(thrown[0][1])[0])
    found = []
    for match in CALL.finditer(text):
        begin = match.start(1) if match.group(1) else match.start(2)
        if begin in declared or match.group(1) in INTERNAL:
            continue
        code = text[match.end():end_of(text, match.end())]
        kind, prefix = (match.group(1), []) if match.group(1) else helpers.get(match.group(2), (None, []))
        always, either = words_in(code)
        if match.group(2) and not always and not either:
            continue  # Says what others do.
        line = bisect.bisect_right(lines, match.start())
        found.append(Site(file, line, kind, f'{match.group(1) or match.group(2)}{code}', prefix + always, either))
    return found


def sites_of(root):
    found = []
    for folder in ('host', 'cpu_ref', 'include'):
        for path in sorted((root / folder).rglob('*')):
            if path.suffix in ('.h', '.cpp'):
                found += sites_in(str(path.relative_to(root)), path.read_text())
    return found

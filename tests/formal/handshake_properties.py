"""Properties of generated Verilog, written into its modules, where they see what only the module sees; and their proofs by
k-induction (yosys-smtbmc with Z3).

Order, number and contents of tokens: counters number the tokens that go in and come out. One number, any, is watched: the
token that went in under it is remembered, and has to be where it should be in between, and come out under the same number.
What is asserted of the inside (which place holds it) makes the induction close; the rest is the promise.
"""

import pathlib
import re
import subprocess
import tempfile

# Every proof starts with a reset; later ones come at any time.
RESET = """
  reg formal_first = 1, formal_started = 0, formal_just_reset = 0;
  always @(posedge clk) begin
    formal_first <= 0;
    formal_started <= formal_started | rst;
    formal_just_reset <= rst;
  end
  always @* if (formal_first) assume (rst);
"""

FIFO = RESET + """
  localparam PLACES = LAST + 1;
  reg [POINTER+1:0] formal_in, formal_out;
  (* anyconst *) reg [POINTER+1:0] formal_watched;
  reg [WIDTH-1:0] formal_expected;
  wire [POINTER+1:0] formal_held = formal_in - formal_out;
  wire [POINTER+1:0] formal_ahead = formal_watched - formal_out;  // tokens that leave before the watched one
  wire [POINTER+1:0] formal_end = out_at + fill;
  wire [POINTER+1:0] formal_place = out_at + formal_ahead - word_there;
  wire [POINTER-1:0] formal_where = formal_place > LAST ? formal_place - PLACES : formal_place;
  reg formal_waited, formal_refused, formal_filled;
  reg [WIDTH-1:0] formal_offered;
  always @(posedge clk) begin
    if (in_tvalid && in_tready && formal_in == formal_watched) formal_expected <= in_tdata;
    formal_in <= rst ? 0 : formal_in + (in_tvalid && in_tready);
    formal_out <= rst ? 0 : formal_out + (out_tvalid && out_tready);
    formal_waited <= ~rst & out_tvalid & ~out_tready;
    formal_offered <= out_tdata;
    formal_filled <= ~rst & (fill != 0);
  end
  always @* if (formal_started) begin
    // Nothing is lost, nothing is there twice, and it does not overflow.
    assert (formal_held == fill + word_there);
    assert (fill <= PLACES);
    if (push) assert (fill < PLACES);
    // The watched token comes out under its number.
    if (out_tvalid && formal_ahead == 0) assert (out_tdata == formal_expected);
    // An offer stands, unchanged, until it is taken.
    if (formal_waited) assert (out_tvalid && out_tdata == formal_offered);
    // No deadlock: a token is offered two clocks after it came, and only a full FIFO refuses.
    if (formal_filled) assert (out_tvalid);
    assert (in_tready == (fill < PLACES && !formal_just_reset));
    // Inside.
    assert (in_at <= LAST && out_at <= LAST);
    assert (in_at == (formal_end > LAST ? formal_end - PLACES : formal_end));
    if (formal_ahead < formal_held && !(word_there && formal_ahead == 0))
      assert (places[formal_where] == formal_expected);
  end
"""

BUFFER = """
  reg [2:0] {n}_formal_in, {n}_formal_out;
  (* anyconst *) reg [2:0] {n}_formal_watched;
  reg [{top}:0] {n}_formal_expected;
  wire [2:0] {n}_formal_held = {n}_formal_in - {n}_formal_out;
  wire [2:0] {n}_formal_ahead = {n}_formal_watched - {n}_formal_out;
  always @(posedge clk) begin
    if ({valid} & {ready} && {n}_formal_in == {n}_formal_watched) {n}_formal_expected <= {token};
    {n}_formal_in <= rst ? 3'd0 : {n}_formal_in + {{2'd0, {valid} & {ready}}};
    {n}_formal_out <= rst ? 3'd0 : {n}_formal_out + {{2'd0, {n}_take}};
  end
  always @* if (formal_started) begin
    // No token is taken that is not there; none is lost; two have room.
    if ({n}_take) assert ({n}_formal_held != 3'd0);
    assert ({n}_formal_held <= 3'd2);
    assert ({n}_there == ({n}_formal_held != 3'd0));
    assert ({ready} == ({n}_formal_held != 3'd2 && !formal_just_reset));  // no deadlock
    if ({n}_take && {n}_formal_ahead == 3'd0) assert ({n}_token == {n}_formal_expected);
    // Inside.
    assert (({n}_fills_second ^ {n}_reads_second) == {n}_formal_held[0]);
    if ({n}_formal_ahead < {n}_formal_held)
      assert ((({n}_formal_ahead[0] ^ {n}_reads_second) ? {n}_second : {n}_first) == {n}_formal_expected);
  end
"""

OUTPUT = """
  (* anyconst *) reg [{counter}:0] {n}_formal_watched;
  reg [{top}:0] {n}_formal_expected, {n}_formal_offered;
  reg {n}_formal_waited, {n}_formal_filled, {n}_formal_overdue;
  wire [{counter}:0] {n}_formal_fill = {n}_in - {n}_out;
  wire [{counter}:0] {n}_formal_sent = {n}_out - {{{zeros}, {n}_word_there}};
  wire [{counter}:0] {n}_formal_ahead = {n}_formal_watched - {n}_formal_sent;
  wire [{counter}:0] {n}_formal_held = {n}_in - {n}_formal_sent;
  wire [{counter}:0] {n}_formal_on_the_way = {on_the_way};
  always @(posedge clk) begin
    if ({n}_push && {n}_in == {n}_formal_watched) {n}_formal_expected <= {n}_data;
    {n}_formal_waited <= ~rst & ~resetting & {valid} & ~{ready};
    {n}_formal_offered <= {n}_word;
    {n}_formal_filled <= ~rst & ~resetting & ({n}_in != {n}_out);
    {n}_formal_overdue <= ~rst & ~resetting & {n}_formal_filled & ~{valid};
  end
  always @* if (formal_started) begin
    if ({n}_formal_waited) assert ({valid} && {n}_word == {n}_formal_offered);
    if (!resetting) begin
      // Whatever is on its way has room, so nothing overflows.
      assert ({n}_formal_fill <= {depth});
      if ({n}_push) assert ({n}_formal_fill < {depth});
      assert ({n}_credits + {n}_formal_on_the_way + {n}_formal_fill + {leaves}{skipped} == {depth});
      if (may_issue) assert ({n}_credits > 1);
      assert ({n}_credits <= {depth} && {n}_credits >= valid[1]);
      // The watched token comes out under its number.
      if ({valid} && {n}_formal_ahead == 0) assert ({n}_word == {n}_formal_expected);
      // No deadlock: what is in the FIFO is offered in the next clock or in the one after it.
      if ({n}_formal_overdue) assert ({valid});
      // Inside.
      assert ({n}_after_out == {n}_out + 1'b1);
      if ({n}_waits) assert ({n}_in != {n}_out);
      if ({n}_formal_ahead < {n}_formal_held && !({valid} && {n}_formal_ahead == 0))
        assert ({n}_fifo[{n}_formal_watched[{pointer}:0]] == {n}_formal_expected);
    end
  end
"""

# What a module gives out: an offer stands, unchanged, until it is taken, and a reset withdraws it.
OFFER = """
  reg [{top}:0] {n}_formal_token;
  reg {n}_formal_stands;
  always @(posedge clk) begin
    {n}_formal_stands <= ~rst & {valid} & ~{ready};
    {n}_formal_token <= {n}_token;
  end
  always @* if (formal_started) begin
    if (formal_just_reset) assert (!{valid});
    if ({n}_formal_stands) assert ({valid} && {n}_token == {n}_formal_token);
  end
"""

# A delay line gives every word back after its clocks, of those that came when its pointers ran again after a reset; the
# first iteration comes later. `{n}_formal_K` is what the line was given K clocks ago, of which two bits are watched: the
# others move in the same assignments.
DELAY_LINE = """
  reg [1:0] {history};
  reg [{pointer}:0] {n}_formal_before;
  always @(posedge clk) begin
    {n}_formal_1 <= {source};
{moves}
    {n}_formal_before <= {out};
  end
  always @* if (formal_started) begin
    if (formal_age >= {clocks} + 4) assert ({target}[1:0] == {n}_formal_{clocks});
    // Inside.
    assert (delay_{words}_out < {words} && {out} < {words});
    if (!formal_just_reset && formal_age != 0) assert ({into} == {n}_formal_before);
    if (formal_age > 3) assert ({out} == ({into} == {words} - 1 ? 0 : {into} + 1));
{kept}
{read}
  end
"""
AGE = """
  reg [6:0] formal_age;  // clocks since pointers run
  always @(posedge clk) formal_age <= rst | resetting ? 7'd0 : formal_age + {6'd0, formal_age != 7'd127};
  always @* if (formal_started) begin
    if (formal_age < 3 && !resetting) assert (holding && hold == 3 - formal_age);
    if (fire) assert (formal_age >= 3);
  end
"""

# Stages are empty when the pipeline comes out of a reset: so many clocks does it wait. After an issue it waits until the
# interval is over: `waits` says which stage holds the iteration that it waits for.
CONTROL = """
  wire [{stages}:1] formal_stages = valid;
  always @* if (formal_started) begin
    if (may_issue) assert (!holding);
    if (resetting) assert (holding && hold >= 4 && hold <= {hold});
    if (holding && !resetting) assert ((formal_stages == 0 && hold != 0 && hold < 4){waits});
{drained}
{apart}
  end
"""


def insert(verilog, module, text):
    """The Verilog with text before the end of a module."""
    start = re.search(rf"(?m)^module {module}\b", verilog).start()
    end = verilog.index("endmodule", start)
    return verilog[:end] + text + verilog[end:]


def with_fifo_properties(verilog):
    return insert(verilog, "epiline_fifo_distributed", FIFO)


def issue_properties(verilog):
    """Of the issue and the wait after a reset."""
    hold = int(re.search(r"      hold <= \d+'d(\d+);", verilog)[1])
    stages = int(re.search(r"reg \[(\d+):1\] valid\b", verilog)[1])
    drained = "\n".join(f"    if (resetting && hold + {stage} <= {hold}) assert (!formal_stages[{stage}]);"
                        for stage in range(1, stages + 1))
    interval = int(re.search(r"one iteration every (?:(\d+) )?clocks?;", verilog)[1] or 1)
    waits = "".join(f" || (hold == {interval - stage} && formal_stages[{stage}])" for stage in range(1, interval))
    apart = "\n".join(f"    if (formal_stages[{stage}] && !resetting) assert (!fire && holding && hold == {interval - stage});"
                      for stage in range(1, interval))
    return RESET + CONTROL.format(stages=stages, hold=hold, drained=drained, waits=waits, apart=apart)


def with_handshake_properties(verilog, module):
    """Properties of the issue and of every stream of a module, and how many there are of inputs and outputs."""
    text = issue_properties(verilog)
    outputs = re.findall(r"wire (\w+)_load = ", verilog)
    buffers = re.findall(r"reg \w+_fills_second, (\w+)_reads_second;", verilog)
    inputs = [name for name in buffers if name.removesuffix("_end") not in outputs]
    for name in buffers:
        top = int(re.search(rf"reg \[(\d+):0\] {name}_first", verilog)[1])
        output = name.removesuffix("_end")
        text += BUFFER.format(
            n=name, top=top, token=re.search(rf"{name}_first <= (.*);", verilog)[1],
            valid=f"s_axis_{name}_tvalid" if name in inputs else f"{output}_word_there", ready=f"{name}_ready")
        if name not in inputs:
            text += OFFER.format(n=name, top=top, valid=f"m_axis_{output}_tvalid", ready=f"m_axis_{output}_tready")
    for name in outputs:
        width, last = re.search(rf"reg \[(\d+):0\] {name}_fifo \[0:(\d+)\]", verilog).groups()
        counter = int(re.search(rf"reg \[(\d+):0\] {name}_in, {name}_out, {name}_after_out;", verilog)[1])
        stage = int(re.search(rf"wire {name}_push = valid\[(\d+)\]", verilog)[1])
        zeros = f"{counter}'d0"
        on_the_way = " + ".join(f"{{{zeros}, valid[{i}]}}" for i in range(2, stage + 1)) or f"{counter + 1}'d0"
        last_clock = int(re.search(rf"reg \[(\d+):0\] {name}_leaves;", verilog)[1])
        leaves = " + ".join(f"{{{zeros}, {name}_leaves[{i}]}}" for i in range(last_clock + 1))
        text += OUTPUT.format(
            n=name, top=width, counter=counter, pointer=counter - 1, depth=int(last) + 1, zeros=zeros,
            on_the_way=on_the_way, leaves=leaves, skipped=f" + {name}_skipped" if f"{name}_skipped" in verilog else "",
            valid=f"{name}_word_there", ready=f"{name}_end_ready")
    return insert(verilog, module, text), len(inputs), len(outputs)


def with_delay_line_properties(verilog, module):
    """Properties of the issue and of every delay line of a module, and how many lines there are."""
    text = issue_properties(verilog) + AGE
    lines = re.findall(r"    (\w+)\[(delay_(\d+)_in\w*)\] <= (.*);\n    (.*) <= \1\[(\w+)\];(?:\n    (.*) <= \1_q;)?", verilog)
    for name, into, words, source, target, out, late in lines:
        words = int(words)
        clocks = words + (1 if late else 0)
        # The word of `age` clocks ago stands so many places behind the next one's.
        kept = "\n".join(f"    if (formal_age >= {age} + 4) assert ({name}[{into} >= {age} ? {into} - {age} : {into} + "
                         f"{words - age}][1:0] == {name}_formal_{age});" for age in range(1, words))
        text += DELAY_LINE.format(
            n=name, pointer=(words - 1).bit_length() - 1, words=words, clocks=clocks, into=into, out=out, source=source,
            target=late or target, kept=kept, history=", ".join(f"{name}_formal_{age}" for age in range(1, clocks + 1)),
            moves="\n".join(f"    {name}_formal_{age} <= {name}_formal_{age - 1};" for age in range(2, clocks + 1)),
            read=f"    if (formal_age >= {words} + 4) assert ({target}[1:0] == {name}_formal_{words});" if late else "")
    return insert(verilog, module, text), len(lines)


def prove(verilog, module, parameters=(), cut="", steps=3, bound=8):
    """("proved" or "refuted" or "not inductive", the tools' output): k-induction over `steps` clocks, and no fault in
    the first `bound` clocks. `cut`: signals that may have any value at any time, instead of the one they have: what is
    proved then holds whatever they carry."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "design.v").write_text(verilog, encoding="utf-8")
        chosen = " ".join(f"-chparam {name} {value}" for name, value in parameters)
        cuts = " ".join(f"cutpoint w:{signal};" for signal in cut.split())
        made = subprocess.run(
            ["yosys", "-Q", "-T", "-p", f"read_verilog -formal design.v; hierarchy -top {module} {chosen}; rename -top top; "
             f"prep -flatten -nordff -top top; {cuts} opt_clean -purge; async2sync; dffunmap; write_smt2 -wires design.smt2"],
            text=True, capture_output=True, check=False, cwd=folder)
        if made.returncode != 0:
            return "not read", made.stdout + made.stderr
        base = ["yosys-smtbmc", "-s", "z3", "--presat", "-m", "top"]
        run = subprocess.run([*base, "-t", str(bound), "design.smt2"], text=True, capture_output=True, check=False, cwd=folder)
        if run.returncode != 0:
            return "refuted", run.stdout + run.stderr
        run = subprocess.run([*base, "-i", "-t", str(steps), "design.smt2"], text=True, capture_output=True, check=False,
                             cwd=folder)
        return "proved" if run.returncode == 0 else "not inductive", run.stdout + run.stderr

// packet_transmitter, packet_receiver and packet_buffer: the CRC is the one everybody knows; content of any bytes comes
// back; a packet with a byte lost, changed or doubled is refused and the next one is not.
`timescale 1ns / 1ps
module packet_bench;
    reg clk = 0, rst = 1;
    always #5 clk = !clk;

    reg  [7:0] data = 0;
    reg        valid = 0, last = 0;
    wire       ready;
    wire [7:0] line;
    wire       line_valid;
    packet_transmitter transmitter (
        .clk(clk), .rst(rst), .data(data), .valid(valid), .last(last), .ready(ready), .byte_data(line),
        .byte_valid(line_valid), .byte_ready(1'b1));

    // What may happen to byte number `fault_at` of the line: 1 lost, 2 changed, 3 doubled (sent as the next byte, too).
    integer    fault = 0, fault_at = 0, position = 0;
    wire       here = position == fault_at;
    wire [7:0] heard = fault == 2 && here ? line ^ 8'h04 : fault == 3 && position == fault_at + 1 ? doubled : line;
    reg  [7:0] doubled;
    wire       heard_valid = line_valid && !(fault == 1 && here);
    always @(posedge clk) if (line_valid) begin
        position <= position + 1;
        if (here) doubled <= line;
    end

    wire [7:0] content;
    wire       content_valid, good, bad;
    packet_receiver receiver (
        .clk(clk), .rst(rst), .byte_data(heard), .byte_valid(heard_valid), .data(content), .valid(content_valid),
        .good(good), .bad(bad));

    reg [7:0] sent[0:255];
    integer length, got = 0, same = 1, goods = 0, bads = 0, errors = 0, i, packets;
    reg [31:0] crc = 0;
    always @(posedge clk) begin
        if (content_valid) begin
            if (content !== sent[got]) same = 0;
            got = got + 1;
        end
        if (good) goods = goods + 1;
        if (bad) bads = bads + 1;
        if (line_valid) crc = {line, crc[31:8]};
    end

    task send_packet;
        begin
            got = 0;
            same = 1;
            goods = 0;
            bads = 0;
            position = 0;
            for (i = 0; i < length; i = i + 1) begin
                data = sent[i];
                valid = 1;
                last = i == length - 1;
                @(negedge clk);
                while (!ready) @(negedge clk);
                @(posedge clk) #1;
            end
            valid = 0;
            repeat (20) @(negedge clk);
        end
    endtask
    task require(input condition, input [8*40-1:0] what);
        if (!condition) begin
            errors = errors + 1;
            $display("FAIL: %0s (length %0d, fault %0d at %0d: %0d good, %0d bad)", what, length, fault, fault_at, goods, bads);
        end
    endtask

    // The buffer.
    reg        put = 0, commit = 0, forget = 0, take = 0;
    reg  [7:0] put_data = 0;
    wire [7:0] taken;
    wire       taken_valid, lost;
    wire [3:0] room;
    packet_buffer #(.ADDRESS_BITS(3)) buffer (
        .clk(clk), .rst(rst), .put_data(put_data), .put(put), .commit(commit), .forget(forget), .lost(lost), .room(room),
        .take_data(taken), .take_valid(taken_valid), .take_ready(take));
    task put_byte(input [7:0] value);
        begin
            put_data = value;
            put = 1;
            @(negedge clk) put = 0;
        end
    endtask

    initial begin
        repeat (4) @(negedge clk);
        rst = 0;
        @(negedge clk);
        // "123456789": 0xcbf43926 stands on the line before the last flag.
        length = 9;
        for (i = 0; i < 9; i = i + 1) sent[i] = 8'h31 + i;
        send_packet;
        require(goods == 1 && bads == 0 && same && got == 9, "a plain packet");
        require(crc[23:0] == 24'hcbf439, "the CRC of 123456789");

        for (packets = 0; packets < 300; packets = packets + 1) begin
            length = 1 + ($random & 63);
            // Many of the bytes that must not stand alone.
            for (i = 0; i < length; i = i + 1) sent[i] = ($random & 3) == 0 ? 8'h7c + ($random & 3) : $random;
            fault = packets & 3;
            fault_at = 1 + ($unsigned($random) % length);
            if (fault == 3 && sent[fault_at] == sent[fault_at-1]) fault = 0;
            send_packet;
            if (fault == 0) require(goods == 1 && bads == 0 && same && got == length, "a packet comes over");
            else if (fault != 3) require(goods == 0, "a damaged packet is refused");
            fault = 0;
            send_packet;
            require(goods == 1 && same && got >= length, "the packet after it comes over");
        end

        put_byte(1);
        put_byte(2);
        repeat (4) @(negedge clk);
        require(!taken_valid, "nothing leaves before the commit");
        forget = 1;
        @(negedge clk) forget = 0;
        put_byte(3);
        put_byte(4);
        commit = 1;
        @(negedge clk) commit = 0;
        repeat (3) @(negedge clk);
        require(taken_valid && taken == 3, "what was forgotten is gone");
        take = 1;
        @(negedge clk);
        require(taken_valid && taken == 4, "the second byte");
        @(negedge clk) take = 0;
        require(!taken_valid && room == 8, "empty again");
        for (i = 0; i < 9; i = i + 1) put_byte(i);
        require(lost, "a byte too many is noticed");
        forget = 1;
        @(negedge clk) forget = 0;
        require(!lost && room == 8, "and forgotten");
        if (errors == 0) $display("passed");
        $finish;
    end
endmodule
